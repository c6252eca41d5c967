"""Pictures made smaller by halves."""

from __future__ import annotations

import math

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from recognizer.video.shrinking import LAST, halved, halves


@given(st.floats(0.01, 500))
def test_halved_so_often_that_little_is_left_and_no_oftener(ratio: float) -> None:
    times = halves(ratio)
    assert ratio / 2**times <= LAST * (1 + 1e-9)
    assert times == 0 or ratio / 2 ** (times - 1) > LAST * (1 - 1e-9)


@given(st.integers(0, 3), st.integers(1, 5), st.integers(1, 5))
def test_a_halved_picture_holds_the_means_of_squares(times: int, rows: int, columns: int) -> None:
    side = 2**times
    picture = np.random.default_rng(rows).uniform(0, 255, (rows * side, columns * side)).astype(np.float32)
    means = picture.reshape(rows, side, columns, side).mean(axis=(1, 3))
    np.testing.assert_allclose(halved(picture, times), means, rtol=1e-5)
    assert math.isclose(halved(picture, times).mean(), picture.mean(), rel_tol=1e-5)
