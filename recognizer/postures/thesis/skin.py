"""Skin pixels: Gray-World light compensation, then a box in YCbCr (S1; thesis chapter 1 (1), eq. 1)."""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.postures.types import Image, Mask

CB_RANGE = (77, 127)
CR_RANGE = (133, 173)


def gray_world_gains(bgr: Image) -> np.ndarray:
    """Return the factor of each channel: the inverse of its mean over the largest inverse (thesis ch. 1 (1-2)).

    Args:
        bgr: (h, w, 3) uint8.

    Returns:
        (3,) float64 in (0, 1]; the darkest channel keeps 1. A channel without any light counts as a mean of 1.
    """
    means = np.maximum(cv2.mean(bgr)[:3], 1.0)
    inverse = 1.0 / np.asarray(means)
    return inverse / inverse.max()


def gray_world(bgr: Image, gains: np.ndarray | None = None) -> Image:
    """Return the picture with equal channel means, as if its scene were grey on average.

    Args:
        bgr: (h, w, 3) uint8.
        gains: (3,) factors to use in place of the picture's own, when it is a crop of a larger one.
    """
    factors = gray_world_gains(bgr) if gains is None else gains
    return np.round(bgr * factors).astype(np.uint8)


def skin_mask(bgr: Image) -> Mask:
    """Return where 77 ≤ Cb ≤ 127 and 133 ≤ Cr ≤ 173 (eq. 1); the luma is ignored.

    Args:
        bgr: (h, w, 3) uint8.

    Returns:
        (h, w) bool.
    """
    ycrcb = cv2.cvtColor(bgr, cv2.COLOR_BGR2YCrCb)
    low = (0, CR_RANGE[0], CB_RANGE[0])
    high = (255, CR_RANGE[1], CB_RANGE[1])
    return cv2.inRange(ycrcb, low, high) > 0
