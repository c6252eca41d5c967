"""The search for head and shoulders against plain ways of computing the same."""

from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from recognizer.person.head_shoulders import HEAD_AT, Body, _square, cells, closer_look, pyramid, score_maps, template


@pytest.fixture(scope="module")
def grey() -> np.ndarray:
    noise = np.random.default_rng(4).uniform(0, 255, (120, 160)).astype(np.float32)
    return cv2.normalize(cv2.GaussianBlur(noise, (0, 0), 2), None, 0, 255, cv2.NORM_MINMAX).astype(np.uint8)


def test_scores_are_correlations_with_zeros_beyond_the_picture(grey: np.ndarray) -> None:
    weights, offset = template()
    column, row = (int(v) for v in HEAD_AT)
    tall, wide, _ = weights.shape
    for (head, level), (same, scores) in zip(pyramid(grey), score_maps(grey, weights, offset), strict=True):
        assert head == same
        assert scores.shape == level.shape[:2]
        padded = np.pad(level, ((row, tall - 1 - row), (column, wide - 1 - column), (0, 0)))
        windows = np.lib.stride_tricks.sliding_window_view(padded, (tall, wide), axis=(0, 1))
        np.testing.assert_allclose(scores, np.einsum("yxcij,ijc->yx", windows, weights) + offset, atol=1e-4)


def test_orientations_share_the_gradient_and_turn_with_the_picture(grey: np.ndarray) -> None:
    found = cells(grey)
    np.testing.assert_allclose(found[..., :6].sum(axis=-1), found[..., 6], atol=1e-4)
    stripes = np.tile((128 + 100 * np.sin(np.arange(64) / 2)).astype(np.uint8), (64, 1))
    upright, lying = (cells(np.ascontiguousarray(s))[4:-4, 4:-4].mean(axis=(0, 1)) for s in (stripes, stripes.T))
    assert np.argmax(upright[:6]) == 0
    assert np.argmax(lying[:6]) == 3


@given(st.integers(-200, 300), st.integers(-200, 300), st.integers(2, 150))
def test_a_square_repeats_the_edge_beyond_the_border(left: int, top: int, size: int) -> None:
    picture = np.arange(40 * 60, dtype=np.int32).reshape(40, 60).astype(np.uint8)
    rows, columns = (np.arange(at, at + size).clip(0, n - 1) for at, n in ((top, 40), (left, 60)))
    np.testing.assert_array_equal(_square(picture, left, top, size), picture[np.ix_(rows, columns)])


def test_the_closer_look_sees_the_same_at_any_size(grey: np.ndarray) -> None:
    large = cv2.resize(grey, None, fx=2, fy=2, interpolation=cv2.INTER_LINEAR)
    small, twice = closer_look(grey, [Body(80, 50, 18, 0.0)]), closer_look(large, [Body(160, 100, 36, 0.0)])
    assert np.corrcoef(small[0], twice[0])[0, 1] > 0.97
