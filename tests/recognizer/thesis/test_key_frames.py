from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.thesis.difference_images import VECTOR_NAMES, difference_image, ellipse_vector, ellipses
from recognizer.thesis.key_frames import (
    equal_motion_frames,
    intersection_curve,
    key_frames,
    least_correlated_pair,
    local_maxima,
)
from recognizer.video.histograms import grey_histogram, histogram_intersection


def disc(x: float, y: float, radius: float = 14, size: tuple[int, int] = (160, 120)) -> np.ndarray:
    image = np.full((size[1], size[0]), 60, np.uint8)
    cv2.circle(image, (round(x), round(y)), round(radius), 220, -1)
    return image


@settings(deadline=None, max_examples=25)
@given(st.lists(st.integers(1, 1000), min_size=4, max_size=4), st.lists(st.integers(1, 1000), min_size=4, max_size=4))
def test_intersection_is_a_share_and_one_only_for_covered_bins(a: list[int], b: list[int]) -> None:
    first, second = np.array(a, float), np.array(b, float)
    value = histogram_intersection(first, second)
    assert 0 < value <= 1
    assert (value == 1) == bool((second >= first).all())


def test_intersection_by_hand() -> None:
    assert histogram_intersection(np.array([2.0, 2.0]), np.array([1.0, 3.0])) == 0.75


def test_histogram_counts_every_pixel() -> None:
    assert grey_histogram(disc(50, 50)).sum() == 160 * 120


def test_local_maxima_of_a_known_curve() -> None:
    assert local_maxima(np.array([0, 2, 1, 3, 3, 0, 5.0])).tolist() == [1, 3]


def test_turning_points_of_a_swing_are_key_frames() -> None:
    # At its turning points a swing resembles its surroundings most.
    t = np.arange(40)
    images = [disc(80 + 30 * np.cos(2 * np.pi * i / 20), 60, 14 + 6 * np.cos(2 * np.pi * i / 20)) for i in t]
    chosen = key_frames(images, group=1)
    assert len(chosen) >= 2
    i, j = least_correlated_pair([images[k] for k in chosen])
    assert i < j
    assert intersection_curve(images).shape == (40,)


def test_least_correlated_pair_is_the_one_far_apart() -> None:
    images = [disc(40, 40), disc(42, 40), disc(120, 90)]
    assert 2 in least_correlated_pair(images)


@pytest.mark.parametrize("count", [2, 6])
def test_a_still_clip_has_key_frames_too(count: int) -> None:
    images = [disc(80, 60)] * 8
    assert len(key_frames(images)) >= 2
    assert len(equal_motion_frames(images, count)) == count


def test_equal_motion_frames_ignore_a_pause() -> None:
    path = [30 + 5 * i for i in range(10)] + [80] * 10 + [80 + 5 * i for i in range(10)]
    chosen = equal_motion_frames([disc(x, 60) for x in path], 6)
    assert chosen[0] == 0
    assert (np.diff(chosen) > 0).all()
    assert sum(10 <= c < 19 for c in chosen) <= 1


def test_difference_keeps_what_moved_and_drops_specks() -> None:
    before, after = disc(50, 60), disc(100, 60)
    after[5:7, 5:7] = 255
    difference = difference_image(before, after)
    assert difference[60, 50] == 160
    assert difference[60, 100] == 160
    assert difference[5, 5] == 0
    assert difference[100, 20] == 0


def test_one_hand_and_two_hands() -> None:
    wall = np.full((120, 160), 60, np.uint8)
    one = ellipse_vector(ellipses(difference_image(wall, disc(40, 30))))
    both = wall.copy()
    cv2.circle(both, (40, 30), 14, 220, -1)
    cv2.circle(both, (120, 50), 13, 220, -1)
    two = ellipse_vector(ellipses(difference_image(wall, both)))
    assert len(one) == len(VECTOR_NAMES) == 12
    np.testing.assert_allclose(one[:2], [40.5 / 160, 30.5 / 120], atol=0.01)
    assert not one[[2, 3, 6, 7, 11]].any()
    np.testing.assert_allclose(one[8:10], one[:2])
    np.testing.assert_allclose(two[:4], [40.5 / 160, 30.5 / 120, 120.5 / 160, 50.5 / 120], atol=0.01)
    np.testing.assert_allclose(two[8:10], [80 / 160, 20 / 120], atol=0.01)


def test_mean_absolute_deviation_of_a_disc() -> None:
    wall = np.full((120, 160), 60, np.uint8)
    region = ellipses(difference_image(wall, disc(80, 60, 20)))[0]
    # Of a uniform disc of radius r it is 4r / 3π.
    assert region.sx * 160 == pytest.approx(4 * 20 / (3 * np.pi), rel=0.05)
    assert region.sy * 120 == pytest.approx(4 * 20 / (3 * np.pi), rel=0.05)


def test_no_motion_gives_zeros() -> None:
    assert not ellipse_vector(ellipses(difference_image(disc(50, 50), disc(50, 50)))).any()
