from __future__ import annotations

import math

import numpy as np
import pytest

from recognizer.motion.amplitude import amplitude, centroid_transition
from recognizer.motion.moving_regions import MovingRegions, moving_mask, moving_regions


@pytest.mark.parametrize(
    ("first", "last", "expected"),
    [
        ((127.9951, 91.7437), (133.0188, 83.4235), 9.7192),
        ((156.5291, 167.0471), (202.4838, 93.6265), 86.6165),
        ((131.5066, 39.8289), (128.6642, 127.8271), 88.0441),
    ],
)
def test_worked_examples_of_chapter_3(first: tuple[float, float], last: tuple[float, float], expected: float) -> None:
    assert centroid_transition(first, last) == pytest.approx(expected, abs=5e-5)


def regions_along(points: list[tuple[float, float]]) -> list[MovingRegions]:
    return [MovingRegions(0.1 * i, np.zeros((0, 4)), p, 0.05) for i, p in enumerate(points)]


def test_a_circle_is_large_by_its_path_and_small_by_its_ends() -> None:
    angles = np.linspace(0, 2 * np.pi, 20)
    circle = [(0.5 + 0.2 * math.cos(a), 0.5 + 0.2 * math.sin(a)) for a in angles]
    assert amplitude(regions_along(circle), (320, 240), "first_to_last").family == "small"
    assert amplitude(regions_along(circle), (320, 240), "whole_path").family == "large"


def test_amplitude_does_not_depend_on_image_size() -> None:
    path = regions_along([(0.2, 0.3), (0.4, 0.6), (0.7, 0.5)])
    assert amplitude(path, (160, 120)).extent == pytest.approx(amplitude(path, (1280, 960)).extent)


@pytest.mark.parametrize("points", [[], [(0.5, 0.5)]])
def test_little_or_no_motion_is_small(points: list[tuple[float, float]]) -> None:
    found = amplitude(regions_along(points), (320, 240))
    assert (found.family, found.transition, found.extent) == ("small", 0.0, 0.0)


def test_moving_square_is_boxed_and_its_velocity_read() -> None:
    u, v = np.zeros((72, 96), np.float32), np.zeros((72, 96), np.float32)
    u[20:40, 30:60] = 3.0
    u[5, 5] = 9.0  # a single pixel is noise: the median takes it away
    found = moving_regions(u, v, 0.5, 0.1)
    assert found.boxes.shape == (1, 4)
    np.testing.assert_allclose(found.boxes[0] * [96, 72, 96, 72], [30, 20, 30, 20], atol=1)
    assert found.centroid == pytest.approx((45 / 96, 30 / 72), abs=0.01)
    assert found.velocity == pytest.approx((3 / 96 / 0.1, 0), rel=0.02)


def test_threshold_is_a_velocity() -> None:
    u = np.full((40, 40), 0.5, np.float32)
    assert moving_mask(u, np.zeros_like(u), 0.1).all()
    assert not moving_mask(u, np.zeros_like(u), 1.0).any()
