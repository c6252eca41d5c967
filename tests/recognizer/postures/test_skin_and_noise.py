from __future__ import annotations

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer.postures.hand.background import departure, foreground
from recognizer.postures.thesis.noise import clean, fill_holes, remove_small
from recognizer.postures.thesis.skin import gray_world, gray_world_gains, skin_mask


def test_gray_world_worked_example():
    # Means 200, 100, 50: inverses 0.005, 0.01, 0.02; over the largest 0.25, 0.5, 1.
    image = np.full((4, 4, 3), (200, 100, 50), np.uint8)
    assert gray_world_gains(image) == pytest.approx([0.25, 0.5, 1.0])
    assert (gray_world(image) == 50).all()


@settings(deadline=None, max_examples=25)
@given(seed=st.integers(0, 10_000))
def test_gray_world_equalises_the_means_and_repeats_without_effect(seed):
    rng = np.random.default_rng(seed)
    image = (rng.uniform(0, 255, (20, 30, 3)) * rng.uniform(0.3, 1, 3)).astype(np.uint8)
    balanced = gray_world(image)
    means = balanced.reshape(-1, 3).mean(axis=0)
    assert np.ptp(means) < 1.0
    assert np.abs(gray_world(balanced).astype(int) - balanced).max() <= 2


def test_gray_world_of_black_and_of_grey_change_nothing():
    for level in (0, 128):
        image = np.full((5, 5, 3), level, np.uint8)
        assert (gray_world(image) == image).all()


def test_skin_box_is_inclusive_and_ignores_luma():
    def bgr(y: int, cr: int, cb: int) -> np.ndarray:
        return cv2.cvtColor(np.full((1, 1, 3), (y, cr, cb), np.uint8), cv2.COLOR_YCrCb2BGR)

    for y in (110, 130, 150):  # where these colours exist in RGB
        assert skin_mask(bgr(y, 150, 100)).all()
        assert not skin_mask(bgr(y, 125, 100)).any()
        assert not skin_mask(bgr(y, 180, 100)).any()
        assert not skin_mask(bgr(y, 150, 135)).any()
        assert not skin_mask(bgr(y, 140, 60)).any()


def test_noise_of_both_types_goes_and_the_hand_stays():
    mask = np.zeros((100, 100), bool)
    mask[20:80, 30:70] = True
    noisy = mask.copy()
    noisy[5, 5] = noisy[90:93, 90:93] = True  # type 1: background taken for skin
    noisy[40:43, 50:53] = False  # type 2: skin taken for background
    assert (clean(noisy, 0.003, 0.002) == mask).all()


def test_large_holes_and_bays_stay_open():
    mask = np.zeros((100, 100), bool)
    mask[20:80, 20:80] = True
    mask[40:60, 40:60] = False  # 4 %: the ring of an OK sign
    assert (fill_holes(mask, 0.002) == mask).all()
    assert fill_holes(mask, 0.05)[50, 50]
    bay = mask.copy()
    bay[:45, 50] = False
    assert not fill_holes(bay, 1.0)[50, 50], "open to the outside is no hole"


def test_remove_small_on_empty_and_full():
    assert not remove_small(np.zeros((10, 10), bool)).any()
    assert remove_small(np.ones((10, 10), bool)).all()


def test_departure_finds_an_object_of_any_colour_before_a_vignetted_background():
    y, x = np.mgrid[-1:1:120j, -1:1:120j]
    light = 1 - 0.3 * (x**2 + y**2)
    image = (np.array([180, 190, 185]) * light[..., None]).astype(np.uint8)
    inside = x**2 + y**2 < 0.25
    image[inside] = (120, 60, 60)
    found = departure(image)
    assert found.plainness > 0.99
    assert (foreground(found) == inside).mean() > 0.99
