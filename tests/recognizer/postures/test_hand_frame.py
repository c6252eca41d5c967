from __future__ import annotations

import cv2
import numpy as np
import pytest

from recognizer.postures.hand.descriptors import NAMES, describe
from recognizer.postures.hand.hand_frame import hand_frames
from recognizer.postures.model_hand.skeleton import reach

from .conftest import unseen_hands


def moved(mask: np.ndarray, turn_deg: float = 0.0, scale: float = 1.0) -> np.ndarray:
    """The mask turned about its lower middle and scaled, in a frame that grows with it; the arm stays at the edge."""
    size = round(mask.shape[0] * scale)
    matrix = cv2.getRotationMatrix2D((mask.shape[1] / 2, mask.shape[0]), turn_deg, scale)
    matrix[:, 2] += [(scale - 1) * mask.shape[1] / 2, (scale - 1) * mask.shape[0]]
    image = mask.astype(np.uint8) * 255
    return cv2.warpAffine(image, matrix, (size, size), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE) > 127


def test_palm_of_an_open_hand():
    for mask in unseen_hands("stop_hand", 6):
        frame = hand_frames(mask)[0]
        x, y = np.round(frame.centre).astype(int)
        assert mask[y, x]
        assert abs(np.rad2deg(frame.up_rad)) < 45
        up = np.array([np.sin(frame.up_rad), -np.cos(frame.up_rad)])
        reach_up = ((np.argwhere(mask)[:, ::-1] - frame.centre) @ up).max()
        assert 2.0 < reach_up / frame.radius < 6, "fingers are two to six palm radii long"


@pytest.mark.parametrize("name", ["stop_hand", "victory", "pointing"])
@pytest.mark.parametrize("turn", [-15, 12])
def test_turning_the_picture_turns_the_frame_and_hardly_changes_the_description(name, turn):
    mask = next(m for m in unseen_hands(name, 10, seed=3) if hand_frames(m)[0].arm_found)
    turned = moved(mask, turn)
    a, b = hand_frames(mask)[0], hand_frames(turned)[0]
    assert np.rad2deg(a.up_rad - b.up_rad) == pytest.approx(turn, abs=9)
    others = [describe(m, hand_frames(m)[0]) for m in unseen_hands("round", 3)]
    base = describe(mask, a)
    change = np.linalg.norm(describe(turned, b) - base)
    assert change < 0.7 * min(np.linalg.norm(o - base) for o in others)


@pytest.mark.parametrize("scale", [0.6, 2.0, 5.0])
def test_scaling_scales_the_frame(scale):
    mask = next(m for m in unseen_hands("four", 10) if hand_frames(m)[0].arm_found)
    a, b = hand_frames(mask)[0], hand_frames(moved(mask, 0, scale))[0]
    assert b.radius / a.radius == pytest.approx(scale, rel=0.08)
    assert np.rad2deg(b.up_rad - a.up_rad) == pytest.approx(0, abs=5)


def test_mirroring_mirrors_the_frame_and_the_view():
    mask = unseen_hands("three", 1)[0]
    a, b = hand_frames(mask)[0], hand_frames(np.ascontiguousarray(mask[:, ::-1]))[0]
    assert b.up_rad == pytest.approx(-a.up_rad, abs=0.05)
    assert b.radius == pytest.approx(a.radius, rel=0.02)


def test_a_floating_hand_gets_an_upright_guess_first():
    mask = np.zeros((200, 200), bool)
    y, x = np.mgrid[:200, :200]
    mask[(x - 100) ** 2 + (y - 120) ** 2 < 30**2] = True
    mask[40:120, 92:108] = True
    frames = hand_frames(mask)
    assert frames[0].up_rad == 0
    assert not frames[0].arm_found


def test_description_has_a_name_for_each_number_and_is_finite():
    for name in ("round", "fist", "perfect"):
        mask = unseen_hands(name, 1)[0]
        vector = describe(mask, hand_frames(mask)[0])
        assert vector.shape == (len(NAMES),)
        assert np.isfinite(vector).all()
    assert len(set(NAMES)) == len(NAMES)


def test_reach_keeps_bone_lengths_and_comes_to_the_target():
    lengths = np.array([0.5, 0.4, 0.3])
    start = np.array([[0, 0, 0], [0.2, 0.4, 0], [0.2, 0.7, 0.1], [0.3, 1, 0.2]], float)
    target = np.array([0.5, 0.5, 0.3])
    chain = reach(start, lengths, target)
    assert np.linalg.norm(np.diff(chain, axis=0), axis=1) == pytest.approx(lengths)
    assert chain[-1] == pytest.approx(target, abs=0.02)
    far = reach(start, lengths, np.array([9.0, 0, 0]))
    assert np.linalg.norm(far[-1]) == pytest.approx(1.2, abs=0.02)
