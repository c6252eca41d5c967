"""Weights of the neighbours' distances: invariances, and what they are for."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.learning.distance_weights import Weights

DISTANCES = st.lists(st.floats(0.05, 50), min_size=6, max_size=6).map(np.array)


def learnt() -> Weights:
    rng = np.random.default_rng(0)
    targets = rng.integers(0, 3, 300)
    near = np.where(targets[:, None] == np.arange(3), 1.0, 2.0)
    return Weights.fit(np.hstack([near, near]) * rng.uniform(0.5, 2, (300, 6)), targets, 3)


@pytest.mark.parametrize("weights", [Weights.plain(3, 0, 2.0), learnt()], ids=["plain", "learnt"])
@given(distances=DISTANCES, scale=st.floats(0.1, 10))
@settings(deadline=None, max_examples=50)
def test_only_ratios_of_distances_count(weights: Weights, distances: np.ndarray, scale: float) -> None:
    shares = weights.shares(distances, np.ones(3, bool))
    assert shares.sum() == pytest.approx(1)
    np.testing.assert_allclose(weights.shares(scale * distances, np.ones(3, bool)), shares, rtol=1e-4, atol=1e-9)


@given(distances=DISTANCES)
@settings(deadline=None, max_examples=50)
def test_plain_weights_are_votes_by_distance(distances: np.ndarray) -> None:
    votes = distances[:3] ** -2.0
    np.testing.assert_allclose(
        Weights.plain(3, 0, 2.0).shares(distances, np.ones(3, bool)), votes / votes.sum(), rtol=1e-6
    )


@given(distances=DISTANCES)
@settings(deadline=None, max_examples=50)
def test_what_the_context_forbids_has_no_share(distances: np.ndarray) -> None:
    shares = Weights.plain(3, 0, 2.0).shares(distances, np.array([True, False, True]))
    assert shares[1] == 0
    assert shares.sum() == pytest.approx(1)


def test_a_class_without_rows_may_be_infinitely_far() -> None:
    distances = np.array([1.0, 2.0, np.inf, 1.0, 2.0, np.inf])
    shares = Weights.plain(3, 0, 2.0).shares(distances, np.ones(3, bool))
    assert shares[:2] == pytest.approx([0.8, 0.2], abs=1e-3)


def test_a_sprawling_class_is_learnt_to_count_less() -> None:
    """Class 0 lies near everything: also class 1's clips are a little nearer to it than to their own."""
    rng = np.random.default_rng(0)
    targets = rng.integers(0, 2, 400)
    sprawling = np.where(targets == 0, 0.6, 0.9) * rng.uniform(0.95, 1.05, 400)
    compact = np.where(targets == 0, 2.0, 1.0) * rng.uniform(0.95, 1.05, 400)
    distances = np.column_stack([sprawling, compact, 1.1 * sprawling, 1.1 * compact])
    plain, learnt = Weights.plain(2, 0, 2.0), Weights.fit(distances, targets, 2)

    assert right(plain, distances, targets) < 0.6
    assert right(learnt, distances, targets) > 0.99


def clips_near_two_kinds(rng: np.random.Generator, n: int) -> tuple[np.ndarray, np.ndarray]:
    """Irrelevant motion is a little nearer to one of two kinds than gestures are to the other, and either may be it.

    Label 0 is the gesture, label 1 irrelevant motion; what is mostly near says nothing, what is nearest says all.
    """
    targets = rng.integers(0, 2, n)
    near, far = np.where(targets == 1, 0.8, 1.2), np.full(n, 2.0)
    swapped = rng.random(n) < 0.5
    kinds = np.column_stack([np.where(swapped, far, near), np.where(swapped, near, far)])
    labels = np.ones((n, 4))
    return np.hstack([labels, kinds]) * rng.uniform(0.95, 1.05, (n, 6)), targets


def right(weights: Weights, distances: np.ndarray, targets: np.ndarray) -> float:
    named = [int(np.argmax(weights.shares(row, np.ones(2, bool)))) for row in distances]
    return float(np.mean(np.array(named) == targets))


def test_the_nearest_kind_of_irrelevant_motion_counts() -> None:
    rng = np.random.default_rng(1)
    learnt = Weights.fit(*clips_near_two_kinds(rng, 400), 2)
    assert right(learnt, *clips_near_two_kinds(rng, 400)) > 0.95


def test_the_network_tells_what_linear_weights_cannot() -> None:
    """One kind near and the other far is the gesture; both near or both far is irrelevant motion."""
    rng = np.random.default_rng(2)

    def clips(n: int) -> tuple[np.ndarray, np.ndarray]:
        near = rng.random((n, 2)) < 0.5
        kinds = np.where(near, 0.5, 2.0) * rng.uniform(0.9, 1.1, (n, 2))
        return np.hstack([np.ones((n, 4)), kinds]), (near[:, 0] == near[:, 1]).astype(int)

    learnt = Weights.fit(*clips(2000), 2)
    alone = Weights(learnt.coefficients, learnt.offsets)
    distances, targets = clips(400)
    assert right(alone, distances, targets) < 0.8
    assert right(learnt, distances, targets) > 0.95


def test_weights_are_stored_and_read_back() -> None:
    rng = np.random.default_rng(3)
    distances, targets = clips_near_two_kinds(rng, 200)
    learnt = Weights.fit(distances, targets, 2)
    back = Weights.of_arrays(learnt.arrays)
    np.testing.assert_array_equal(
        back.shares(distances[0], np.ones(2, bool)), learnt.shares(distances[0], np.ones(2, bool))
    )
    alone = Weights.fit(distances, targets, 2, network=False)
    assert alone.network is None
    np.testing.assert_array_equal(alone.coefficients, learnt.coefficients)
    plain = Weights.plain(2, 2, 2.0)
    assert Weights.of_arrays(plain.arrays).network is None
