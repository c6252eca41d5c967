"""Smaller pictures by halves: the mean of four whole pixels is quick, that of parts of pixels is not."""

from __future__ import annotations

import math

import cv2
import numpy as np

LAST = 1.5  # times smaller than what it is made of a window may be without skipping much


def halves(ratio: float) -> int:
    """How often a picture must be halved until no more than LAST is left of ``ratio``."""
    return max(0, math.ceil(math.log2(ratio / LAST)))


def halved(picture: np.ndarray, times: int) -> np.ndarray:
    """Halve a picture (h, w) so often; a side that is no multiple of 2 to the power of ``times`` is squeezed to fit."""
    for _ in range(times):
        height, width = picture.shape
        picture = cv2.resize(picture, (max(1, width // 2), max(1, height // 2)), interpolation=cv2.INTER_AREA)
    return picture
