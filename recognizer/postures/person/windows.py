"""Windows around a hand of a person in view, described by gradients, without a mask.

While hands are looked for, a window is described by orientation cells (`recognizer.person.head_shoulders.cells`) of its
grey picture and of how much each pixel is coloured like the person's face.
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.person.head_shoulders import BINS, CELL, cells
from recognizer.postures.types import Floats, Image

RIM = 4  # cells around a window that even out the contrast, then go
HAND, CELLS = 14, 12  # pixels of a hand's length and cells of the window in which hands are looked for
CHANNELS = 2 * (BINS + 1) + 1
LIKENESS_WEIGHT = 2.0
FACE_SCALE = (44.0, 10.0, 10.0)  # Lab units: lightness tells hand from face less than colour does


def lab(bgr: Image) -> np.ndarray:
    """Return CIE L*a*b*, (h, w, 3) float32, L 0 to 100."""
    return cv2.cvtColor(bgr.astype(np.float32) / 255, cv2.COLOR_BGR2LAB)


def like_face(colours: np.ndarray, face: Floats) -> np.ndarray:
    """Return how much Lab colours (h, w, 3) are like a face's (3,), 0 to 1."""
    scale = np.array(FACE_SCALE, np.float32)
    away = ((colours - np.asarray(face, np.float32)) / scale) ** 2
    return np.asarray(np.exp(-away.sum(axis=2)), np.float32)


def channels(bgr: Image, likeness: np.ndarray) -> np.ndarray:
    """Return the cells of a picture, (h // 2, w // 2, 15): grey, likeness to skin, and that likeness itself."""
    grey = cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)
    rows, columns = grey.shape[0] // CELL, grey.shape[1] // CELL
    whole = likeness[: rows * CELL, : columns * CELL]
    mean = LIKENESS_WEIGHT * cv2.resize(whole, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.dstack([cells(grey), cells(likeness * 255), mean])


def window_vector(bgr: Image, middle: Floats, hand: float, face: Floats, turn_rad: float = 0.0) -> np.ndarray:
    """Return the window around a place of a photo, (2160,) float32.

    Args:
        bgr: (h, w, 3) uint8 photo.
        middle: (2,) x, y of the middle finger's knuckle, pixels.
        hand: length of the hand, wrist to fingertips, pixels.
        face: (3,) Lab colour of the face.
        turn_rad: the window stands turned by so much.
    """
    window = cut_window(bgr, middle, hand, HAND, CELL * (CELLS + 2 * RIM), turn_rad)
    inside = slice(RIM, -RIM)
    return channels(window, like_face(lab(window), face))[inside, inside].ravel()


def cut_window(bgr: Image, middle: Floats, hand: float, pixels: int, side: int, turn_rad: float = 0.0) -> Image:
    """Return a (side, side, 3) window of a photo in which the hand is ``pixels`` long; the border is repeated."""
    scale = pixels / hand
    reach = 0.75 * side / scale + 3
    x, y = (max(0, int(v - reach)) for v in middle)
    part = bgr[y : int(middle[1] + reach) + 1, x : int(middle[0] + reach) + 1]
    if part.size == 0:
        part, x, y = bgr, 0, 0
    if scale < 0.6:  # averaged first, or thin fingers would be sampled away
        part = cv2.GaussianBlur(part, (0, 0), 0.45 / scale)
    c, s = np.cos(turn_rad) * scale, np.sin(turn_rad) * scale
    turn = np.array([[c, -s], [s, c]])
    move = np.array([side / 2, side / 2]) - 0.5 - turn @ (np.asarray(middle) - [x, y])
    return cv2.warpAffine(
        part, np.column_stack([turn, move]), (side, side), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE
    )
