"""Windows around a hand of a person in view, described by gradients, without a mask.

A hand of forty pixels before a bookcase cannot be divided from it by colour alone, but its edges stand where a hand's
edges stand. A window is described by orientation cells (`recognizer.finder.cells`) of its grey picture and of how
much each pixel is coloured like skin: like the person's face while hands are looked for, like the palm in the
window's middle when a posture is named, since face and hand are lit differently.
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.finder import BINS, CELL, cells
from recognizer.static.types import Floats, Image

RIM = 4  # cells around a window that even out the contrast, then go
COARSE_HAND, COARSE = 14, 12  # pixels of a hand's length and cells of the window in which hands are looked for
FINE_HAND, FINE, POOLED = 44, 36, 2  # the same for naming postures; cells are averaged two by two
CHANNELS = 2 * (BINS + 1) + 1
LIKENESS_WEIGHT = 2.0
FACE_SCALE = (44.0, 10.0, 10.0)  # Lab units: lightness tells hand from face less than colour does
PALM_AT = (0.0, 0.18)  # hand lengths right and down of the window's middle, the middle finger's knuckle
PALM_RADIUS = 0.115  # hand lengths
PALM_LEAST = (5.0, 2.5, 2.5)  # least spread of a palm's colour, Lab with lightness weighted
PALM_SCALE = 3.1  # spreads
LIGHTNESS_WEIGHT = 0.6


def lab(bgr: Image) -> np.ndarray:
    """Return CIE L*a*b*, (h, w, 3) float32, L 0 to 100."""
    return cv2.cvtColor(bgr.astype(np.float32) / 255, cv2.COLOR_BGR2LAB)


def like_face(colours: np.ndarray, face: Floats) -> np.ndarray:
    """Return how much Lab colours (h, w, 3) are like a face's (3,), 0 to 1."""
    scale = np.array(FACE_SCALE, np.float32)
    away = ((colours - np.asarray(face, np.float32)) / scale) ** 2
    return np.asarray(np.exp(-away.sum(axis=2)), np.float32)


def like_palm(colours: np.ndarray, hand: float) -> np.ndarray:
    """Return how much the Lab colours (h, w, 3) of a window are like its palm's, 0 to 1; ``hand`` in pixels."""
    weighted = colours * np.array([LIGHTNESS_WEIGHT, 1, 1], np.float32)
    rows, columns = np.indices(colours.shape[:2])
    middle = np.array(colours.shape[1::-1]) / 2 + np.array(PALM_AT) * hand
    palm = weighted[np.hypot(columns - middle[0], rows - middle[1]) < PALM_RADIUS * hand]
    colour = np.median(palm, axis=0)
    spread = np.maximum(1.4826 * np.median(np.abs(palm - colour), axis=0), PALM_LEAST) * PALM_SCALE
    away = ((weighted - colour) / spread) ** 2
    return np.asarray(np.exp(-away.sum(axis=2)), np.float32)


def channels(bgr: Image, likeness: np.ndarray) -> np.ndarray:
    """Return the cells of a picture, (h // 2, w // 2, 15): grey, likeness to skin, and that likeness itself."""
    grey = cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)
    rows, columns = grey.shape[0] // CELL, grey.shape[1] // CELL
    whole = likeness[: rows * CELL, : columns * CELL]
    mean = LIKENESS_WEIGHT * cv2.resize(whole, (columns, rows), interpolation=cv2.INTER_AREA)
    return np.dstack([cells(grey), cells(likeness * 255), mean])


def coarse_vector(bgr: Image, middle: Floats, hand: float, face: Floats, turn_rad: float = 0.0) -> np.ndarray:
    """Return the coarse window around a place of a photo, (2160,) float32.

    Args:
        bgr: (h, w, 3) uint8 photo.
        middle: (2,) x, y of the middle finger's knuckle, pixels.
        hand: length of the hand, wrist to fingertips, pixels.
        face: (3,) Lab colour of the face.
        turn_rad: the window stands turned by so much.
    """
    window = cut_window(bgr, middle, hand, COARSE_HAND, CELL * (COARSE + 2 * RIM), turn_rad)
    inside = slice(RIM, -RIM)
    return channels(window, like_face(lab(window), face))[inside, inside].ravel()


def fine_vector(bgr: Image, middle: Floats, hand: float, turn_rad: float = 0.0) -> np.ndarray:
    """Return the fine window around a place, (4860,) float32; arguments as for `coarse_vector`."""
    window = cut_window(bgr, middle, hand, FINE_HAND, CELL * (FINE + 2 * RIM), turn_rad)
    found = like_palm(lab(cv2.GaussianBlur(window, (0, 0), 0.7)), FINE_HAND)
    inside = channels(window, found)[RIM:-RIM, RIM:-RIM]
    side = FINE // POOLED
    return np.asarray(inside.reshape(side, POOLED, side, POOLED, CHANNELS).mean(axis=(1, 3)).ravel(), np.float32)


def mirrored(fine: np.ndarray) -> np.ndarray:
    """Return fine vectors (n, 4860) as seen in a mirror: the other hand."""
    side = FINE // POOLED
    turned = np.array([*(-np.arange(BINS) % BINS), BINS])
    order = np.concatenate([turned, turned + BINS + 1, [CHANNELS - 1]])
    return fine.reshape(-1, side, side, CHANNELS)[:, :, ::-1][..., order].reshape(len(fine), -1)


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
