from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.postures.thesis.chamfer import DIAGONAL, STRAIGHT, chamfer_distance, feature_pixels, feature_range


def brute_force(mask: np.ndarray) -> np.ndarray:
    """On an unobstructed grid the cheapest path takes min(dx, dy) diagonal steps and straight ones for the rest."""
    ys, xs = np.nonzero(~mask)
    out = np.zeros(mask.shape)
    for y, x in zip(*np.nonzero(mask), strict=True):
        dy, dx = np.abs(ys - y), np.abs(xs - x)
        out[y, x] = (np.minimum(dx, dy) * DIAGONAL + np.abs(dx - dy) * STRAIGHT).min()
    return out


@settings(deadline=None, max_examples=40)
@given(seed=st.integers(0, 10_000), height=st.integers(1, 14), width=st.integers(1, 14), fill=st.floats(0.3, 0.97))
def test_two_passes_equal_brute_force(seed, height, width, fill):
    mask = np.random.default_rng(seed).uniform(size=(height, width)) < fill
    mask[0, 0] = False
    assert chamfer_distance(mask) == pytest.approx(brute_force(mask))


def test_no_background_is_infinitely_far():
    assert np.isinf(chamfer_distance(np.ones((3, 4), bool))).all()


def test_feature_pixels_of_a_bar_are_its_middle_line():
    mask = np.zeros((41, 80), bool)
    mask[15:26, 5:75] = True  # 11 rows: the middle one is 6 from the background
    found = feature_pixels(chamfer_distance(mask), 4, 12)
    assert found[20, 12:68].all()
    assert set(np.nonzero(found)[0]) == {20}
    assert not feature_pixels(chamfer_distance(mask), 7, 12).any()


def test_feature_range_grows_with_the_picture():
    assert feature_range(144) == (4, 12)
    assert feature_range(288) == (8, 24)
