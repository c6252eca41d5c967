"""Choosing the person among what looks like one."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from recognizer.person.ranking import Ranking
from recognizer.person.training.ranking_training import learn


def candidates(n: int, seed: int) -> tuple[np.ndarray, np.ndarray]:
    """Who is large and moves little, or small and moves much, is the person; the third column says nothing."""
    table = np.random.default_rng(seed).normal([3, -2, 0], [2, 0.5, 1], (n, 3))
    return table, (table[:, 0] - 3) * (table[:, 1] + 2) < 0


@pytest.fixture(scope="module")
def learnt() -> Ranking:
    return learn(*candidates(2000, 0))


def test_pairs_of_columns_tell_the_person(learnt: Ranking) -> None:
    table, right = candidates(500, 1)
    assert np.mean((learnt(table) > 0) == right) > 0.95


def test_what_is_further_off_than_anything_learnt_counts_no_more(learnt: Ranking) -> None:
    assert learnt(np.array([[1e6, -1e6, 0.0]]))[0] == pytest.approx(learnt(np.array([[1e3, -1e3, 0.0]]))[0])


def test_weights_are_written_and_read_back(learnt: Ranking, tmp_path: Path) -> None:
    learnt.save(tmp_path / "ranking.npz")
    with np.load(tmp_path / "ranking.npz") as stored:
        back = Ranking(**{name: stored[name] for name in stored.files})
    table, _ = candidates(20, 2)
    np.testing.assert_allclose(back(table), learnt(table), rtol=1e-4, atol=1e-4)
