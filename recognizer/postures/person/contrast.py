"""A hand divided from its surroundings by local contrast, when neither skin box nor plain background can do it.

Each pixel goes to whichever is nearer in colour: the hand around the palm, or the background beside the pixel. The
two colours are means over a neighbourhood and follow shading and texture; fingers a few pixels wide, blurred by the
camera, end where their colour is half way (localised regions: Lankton and Tannenbaum, IEEE TIP 2008).
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.postures.thesis.noise import clean
from recognizer.postures.types import Floats, Image, Mask

TURNS = 3
LIGHTNESS_WEIGHT = 0.6  # a fold of the hand is darker, not of another colour
FAR = 8.0  # robust standard deviations from the palm's colour that are never hand
BEYOND = 9.0  # core radii: no hand reaches further from its palm
AROUND = 3.2  # core radii from which what is unlike the palm is background to begin with
NEIGHBOURHOOD = 0.07  # of the picture's side


def divide(bgr: Image, palm: Floats, core: float) -> Mask | None:
    """Return the hand's pixels, (h, w) bool, or None when nothing holds together at the palm.

    Args:
        bgr: (h, w, 3) uint8 window around one hand.
        palm: (2,) x, y, a place that is hand for sure.
        core: radius in pixels around it that is hand.
    """
    weights = np.array([LIGHTNESS_WEIGHT, 1.0, 1.0], np.float32)
    smooth = cv2.GaussianBlur(bgr, (0, 0), 0.8).astype(np.float32) / 255
    lab: np.ndarray = cv2.cvtColor(smooth, cv2.COLOR_BGR2LAB) * weights
    rows, columns = np.indices(bgr.shape[:2])
    away = np.hypot(columns - palm[0], rows - palm[1])
    inside = away < core
    colour = np.median(lab[inside], axis=0)
    spread = np.maximum(1.4826 * np.median(np.abs(lab[inside] - colour), axis=0), [5.0, 2.5, 2.5])
    unlike = np.sqrt((((lab - colour) / spread) ** 2).sum(axis=2))
    possible = (unlike < FAR) & (away <= BEYOND * core)
    near = NEIGHBOURHOOD * max(bgr.shape[:2])
    hand_colour = np.broadcast_to(colour, lab.shape)
    background, _ = _mean_around(lab, (away > AROUND * core) & (unlike > 2.5), 2 * near)
    hand: Mask | None = None
    for _ in range(TURNS):
        closer = ((lab - hand_colour) ** 2).sum(axis=2) < ((lab - background) ** 2).sum(axis=2)
        like_hand = closer & possible
        hand = _holding(like_hand, inside)
        if hand is None:
            return None
        mean, weight = _mean_around(lab, hand, near)
        hand_colour = 0.5 * colour + 0.5 * np.where((weight > 0.02)[..., None], mean, colour)
        outside = cv2.dilate(like_hand.astype(np.uint8), np.ones((5, 5), np.uint8)) == 0
        mean, weight = _mean_around(lab, outside, near)
        wide, _ = _mean_around(lab, outside, 4 * near)
        background = np.where((weight > 0.01)[..., None], mean, wide)
    return None if hand is None else clean(hand)


def _holding(mask: Mask, inside: Mask) -> Mask | None:
    """Return the object of the mask that holds most of the core."""
    _, labels = cv2.connectedComponents(mask.astype(np.uint8), connectivity=8)
    votes = np.bincount(labels[inside], minlength=2)
    votes[0] = 0
    return labels == int(votes.argmax()) if votes.any() else None


def _mean_around(picture: np.ndarray, mask: Mask, sigma: float) -> tuple[np.ndarray, np.ndarray]:
    """Return the mean colour of the mask's pixels around every pixel, and how much of the neighbourhood they are."""
    kept = mask.astype(np.float32)
    weight = cv2.GaussianBlur(kept, (0, 0), sigma)
    total = cv2.GaussianBlur(picture * kept[..., None], (0, 0), sigma)
    return total / np.maximum(weight, 1e-6)[..., None], weight
