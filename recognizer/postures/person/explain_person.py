"""Pictures of how the hand of a person in view is named: head, places like a hand, and what the network reads there."""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.postures.person.hand_net import HAND, MOST, SIDE, look
from recognizer.postures.person.person_in_view import SHOWN, Person
from recognizer.postures.person.posture_shares import Shares, look_at
from recognizer.postures.person.windows import cut_window
from recognizer.postures.types import Image

CHOSEN, OTHER, HEAD = (80, 200, 80), (40, 210, 240), (230, 120, 40)
WINDOW = SIDE / HAND  # hand lengths: side of a window
TALL = 480  # pixels: rows to which a smaller photo is enlarged
ZOOM = 3
NAMED = 4  # labels whose shares are written beside a window


def person_pictures(image: Image, person: Person) -> dict[str, Image]:
    """Return the photo with head and places, and the windows as they are cut out and as the network reads them."""
    found = look_at(image, person.spots[:SHOWN])
    pictures = {"head_and_hands": _marked(image, person, found)}
    if found:
        pictures["what_the_network_reads"] = np.vstack([_row(image, shares) for shares in found])
    return pictures


def _marked(image: Image, person: Person, found: list[Shares]) -> Image:
    zoom = max(1.0, TALL / image.shape[0])
    picture = cv2.resize(image, None, fx=zoom, fy=zoom, interpolation=cv2.INTER_CUBIC)
    head = person.head
    centre = round(head.x * zoom), round(head.y * zoom)
    axes = round(0.38 * head.head * zoom), round(0.5 * head.head * zoom)
    cv2.ellipse(picture, centre, axes, 0, 0, 360, HEAD, 2, cv2.LINE_AA)
    for number, shares in reversed(list(enumerate(found))):
        spot, colour = shares.spot, OTHER if number else CHOSEN
        corner = np.round((spot.middle - WINDOW * spot.hand / 2) * zoom).astype(int)
        opposite = np.round((spot.middle + WINDOW * spot.hand / 2) * zoom).astype(int)
        cv2.rectangle(picture, _point(corner), _point(opposite), colour, 1 if number else 2, cv2.LINE_AA)
        if number == 0:
            label, share = _likeliest(shares)[0]
            _write(picture, f"{label} {share:.0%}", (int(corner[0]), int(opposite[1]) + 20), colour)
    return picture


def _row(image: Image, shares: Shares) -> Image:
    """The window, its even contrast, its colours beyond the palm's, and the shares."""
    spot = shares.spot
    window = cut_window(image, spot.middle, spot.hand, HAND, SIDE)
    read = np.round((look(window) + MOST) * (255 / (2 * MOST))).astype(np.uint8)
    views = [window, np.repeat(read[..., :1], 3, axis=2), read[..., 1:]]
    text = np.full((SIDE * ZOOM, SIDE * ZOOM, 3), 30, np.uint8)
    for line, (label, share) in enumerate(_likeliest(shares)[:NAMED]):
        _write(text, f"{share:4.0%} {label}", (10, 34 + 30 * line), (240, 240, 240))
    size = (SIDE * ZOOM, SIDE * ZOOM)
    return np.hstack([*(cv2.resize(view, size, interpolation=cv2.INTER_NEAREST) for view in views), text])


def _likeliest(shares: Shares) -> list[tuple[str, float]]:
    return sorted(shares.by_label.items(), key=lambda item: -item[1])


def _write(picture: Image, text: str, at: tuple[int, int], colour: tuple[int, ...]) -> None:
    font, size = cv2.FONT_HERSHEY_SIMPLEX, 0.55
    (wide, high), below = cv2.getTextSize(text, font, size, 1)
    cv2.rectangle(picture, (at[0] - 2, at[1] - high - 3), (at[0] + wide + 2, at[1] + below), (30, 30, 30), -1)
    cv2.putText(picture, text, at, font, size, colour, 1, cv2.LINE_AA)


def _point(values: np.ndarray) -> tuple[int, int]:
    return int(values[0]), int(values[1])
