"""A person with face, arm and hand in view: the hand is looked for off the face, at the size the head tells."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from recognizer.finder import Body
from recognizer.static import candidates
from recognizer.static.contrast import divide
from recognizer.static.errors import NoHandError
from recognizer.static.person import HAND, find_person, look_closer, places

from .conftest import PAPER_BGR, SKIN_BGR, unseen_hands

SHIRT_BGR = (120, 60, 40)


def person_photo(
    hand: np.ndarray, head: float, skin: tuple[int, ...] = SKIN_BGR
) -> tuple[np.ndarray, Body, np.ndarray]:
    """A head on shoulders in a shirt, a raised sleeved arm, and a hand of 0.95 heads beside the head.

    Returns:
        picture, head, and (2,) where the middle of the hand is.
    """
    width, height = round(8 * head), round(6 * head)
    picture = np.full((height, width, 3), PAPER_BGR, np.uint8)
    x, y = round(4 * head), round(1.6 * head)
    cv2.ellipse(picture, (x, round(y + 3.4 * head)), (round(1.1 * head), round(2.7 * head)), 0, 0, 360, SHIRT_BGR, -1)
    cv2.rectangle(picture, (x - round(0.2 * head), y), (x + round(0.2 * head), y + round(0.8 * head)), skin, -1)
    cv2.ellipse(picture, (x, y), (round(0.37 * head), round(0.5 * head)), 0, 0, 360, skin, -1)
    ys, xs = np.nonzero(hand)
    cut = hand[ys.min() : ys.max() + 1, xs.min() : xs.max() + 1]
    scale = HAND * 1.1 * head / cut.shape[0]
    small = cv2.resize(cut.astype(np.float32), None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)[..., None]
    left, top = round(2.2 * head), round(0.9 * head)
    part = picture[top : top + small.shape[0], left : left + small.shape[1]]
    part[:] = np.round(small * np.array(skin) + (1 - small) * part)
    bottom = top + small.shape[0]
    cv2.rectangle(picture, (left, bottom), (left + small.shape[1], bottom + round(head)), SHIRT_BGR, -1)
    noise = np.random.default_rng(0).normal(0, 2, picture.shape)
    middle = np.array([left + small.shape[1] / 2, top + small.shape[0] / 2])
    return np.clip(picture + noise, 0, 255).astype(np.uint8), Body(x, y, head, 1.0), middle


def with_head(monkeypatch: pytest.MonkeyPatch, body: Body) -> None:
    """Say where the head is, as drawn; the finder has learnt real outlines, not this drawing."""
    monkeypatch.setattr(candidates, "find_person", lambda picture: body)


@pytest.mark.parametrize("skin", [SKIN_BGR, (45, 62, 92)])
def test_a_place_is_the_hand_and_none_is_the_face(skin):
    picture, body, middle = person_photo(unseen_hands("stop_hand", 1, seed=21)[0], 80.0, skin)
    found = places(picture, body)
    assert found
    assert min(np.hypot(*(place.palm - middle)) for place in found) < 0.4 * found[0].hand
    assert all(np.hypot(place.palm[0] - body.x, place.palm[1] - body.y) > 0.5 * body.head for place in found)


def test_the_hand_and_not_the_face_is_named(monkeypatch, recognizer):
    named = []
    for name in ("stop_hand", "victory", "pointing", "four"):
        for hand in unseen_hands(name, 2, seed=21):
            picture, body, _ = person_photo(hand, 80.0)
            with_head(monkeypatch, body)
            try:
                named.append(recognizer.recognize(picture).nearest == name)
            except NoHandError:
                named.append(False)
    assert np.mean(named) >= 0.6, named


def test_a_hand_too_small_for_its_fingers_is_rejected_for_that_reason(monkeypatch, recognizer):
    picture, body, _ = person_photo(unseen_hands("stop_hand", 1, seed=21)[0], 26.0)
    with_head(monkeypatch, body)
    answer = recognizer.recognize(picture)
    assert answer.rejected
    assert answer.label is None
    assert "too small" in answer.reason
    assert answer.to_dict()["distance"] is None


def test_a_close_up_has_no_person_in_view():
    from .conftest import hand_photo

    photos = [hand_photo(mask) for name in ("stop_hand", "round", "three") for mask in unseen_hands(name, 3)]
    assert np.mean([find_person(photo) is None for photo in photos]) >= 0.6


@pytest.mark.parametrize("beside", [(140, 150, 190), (60, 90, 120), (200, 120, 90)])
def test_local_contrast_follows_shading_where_one_colour_does_not(beside):
    """The hand darkens to one side as much as it differs from the background."""
    hand = unseen_hands("stop_hand", 1, seed=21)[0]
    light = np.linspace(1.1, 0.75, hand.shape[1])[None, :, None]
    picture = np.where(hand[..., None], np.array(SKIN_BGR), np.array(beside)) * light
    picture = np.clip(picture + np.random.default_rng(0).normal(0, 2, picture.shape), 0, 255).astype(np.uint8)
    palm = cv2.distanceTransform(hand.astype(np.uint8), cv2.DIST_L2, 5)
    y, x = np.unravel_index(int(np.argmax(palm)), palm.shape)
    found = divide(picture, np.array([x, y], float), 0.6 * palm.max())
    assert found is not None
    above = np.arange(hand.shape[0])[:, None] < y  # the arm below may be cut
    overlap = (found & hand & above).sum() / ((found | hand) & above).sum()
    assert overlap > 0.9


def test_a_place_without_a_hand_yields_nothing():
    from recognizer.static.person import Place

    flat = np.full((200, 200, 3), 180, np.uint8)
    assert list(look_closer(flat, Place(np.array([100.0, 100.0]), 60.0))) == []
