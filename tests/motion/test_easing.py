import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.motion.easing import EASINGS, ease

angles = st.integers(-20_000, 20_000).map(lambda tenths: tenths / 10_000)
keys = st.lists(st.tuples(st.floats(0.05, 2.0), angles), min_size=1, max_size=8)


@pytest.mark.parametrize("easing", EASINGS)
@settings(deadline=None, max_examples=60)
@given(rows=keys, start=angles)
def test_passes_through_every_key_and_stays_between_them(easing, rows, start):
    times = np.concatenate([[0.0], np.cumsum([gap for gap, _ in rows])])
    values = np.array([start, *(value for _, value in rows)])
    assert np.allclose(ease(times, values, times, easing), values, atol=1e-9)
    at = np.linspace(-0.5, times[-1] + 0.5, 200)
    curve = ease(times, values, at, easing)
    assert curve.min() >= values.min()
    assert curve.max() <= values.max()
    assert np.all(curve[at <= 0] == start)
    assert np.allclose(curve[at >= times[-1]], values[-1], atol=1e-12)


def test_one_piece_is_the_minimum_jerk_movement():
    at = np.linspace(0.0, 1.0, 11)
    expected = 10 * at**3 - 15 * at**4 + 6 * at**5
    assert np.allclose(ease(np.array([0.0, 1.0]), np.array([0.0, 1.0]), at, "minimum_jerk"), expected)


@pytest.mark.parametrize("easing", ["minimum_jerk", "cubic"])
def test_rests_at_turning_points(easing):
    times, values = np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 0.0])
    near = np.array([0.5 - 1e-4, 0.5, 0.5 + 1e-4])
    curve = ease(times, values, near, easing)
    assert np.abs(np.diff(curve)).max() < 1e-6


def test_cubic_turns_round_and_minimum_jerk_dwells():
    times, values = np.array([0.0, 0.5, 1.0]), np.array([0.0, 1.0, 0.0])
    at = np.array([0.45])
    assert ease(times, values, at, "cubic")[0] < ease(times, values, at, "minimum_jerk")[0]
