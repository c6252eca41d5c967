"""Small statistics of the features, against NumPy's own."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recognizer.features.body_features import _correlation, _spread, describe, names, vector
from recognizer.features.step_history import Steps
from recognizer.learning.mirror import mirrored
from recognizer.networks.motion_net import FEATURES
from recognizer.person.head_shoulders import Body
from recognizer.person.steps import make_step
from recognizer.person.view import HEAD, POSE

VALUES = st.lists(st.floats(-5, 5), min_size=2, max_size=40).map(np.array)


@given(values=VALUES)
def test_spread_lies_between_two_quantiles(values: np.ndarray) -> None:
    low, high = np.quantile(values, (0.05, 0.95))
    assert _spread(values) == pytest.approx(high - low, abs=1e-9)


@given(values=VALUES)
def test_correlation_with_time(values: np.ndarray) -> None:
    when = np.arange(len(values))
    if values.std() > 1e-3:
        assert _correlation(values, when) == pytest.approx(float(np.corrcoef(values, when)[0, 1]), abs=1e-6)
    assert _correlation(np.full(len(values), 2.0), when) == 0


def test_the_heads_places_turn_round_in_the_mirror() -> None:
    def described(side: float) -> np.ndarray:
        rng = np.random.default_rng(0)
        steps = Steps(8)
        for k in range(1, 9):
            place = np.array([side * rng.normal(), rng.normal()], np.float32)
            still = np.zeros((2, *HEAD.size[::-1]), np.float32)
            flow = np.ones((2, 64, 80), np.float32) * [[[0.0]], [[1.0]]]
            pose = np.zeros(POSE.size[::-1], np.uint8)
            steps.append(make_step(0.1 * k, 0.1, flow[0], flow, still, pose, place))
        motion = np.zeros((8, 17), np.float32)
        motion[:, 1] = 0.1
        items = describe(steps, motion, np.zeros((2, FEATURES)), [], Body(40, 40, 10, 0), (320, 240))
        assert np.abs(dict(items)["head_places"]).min() > 0
        return vector(items)

    here, there = described(1.0), described(-1.0)
    assert np.abs(here - there).max() > 0.1
    np.testing.assert_allclose(mirrored(here[None])[0][_places()], there[_places()], atol=1e-6)


def _places() -> np.ndarray:
    return np.flatnonzero([name.startswith("head_places") for name in names()])
