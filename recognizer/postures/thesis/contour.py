"""The hand's outline: Sobel gradient, order along it, moving-window fit (S5; thesis chapter 1 (2-3))."""

from __future__ import annotations

import cv2
import numpy as np
from scipy.signal import savgol_filter

from recognizer.postures.types import Contour, Image, Mask

# 1600×1200 pictures became 176×144 (thesis): 144 rows, pixels narrower by this much.
ROWS = 144
ASPECT = (176 / 1600) / (144 / 1200)


def to_thesis_size(bgr: Image) -> Image:
    """Return the picture at 144 rows by cubic interpolation; a 4:3 picture becomes 176×144 as in the thesis."""
    height, width = bgr.shape[:2]
    columns = max(1, round(ASPECT * width * ROWS / height))
    return cv2.resize(bgr, (columns, ROWS), interpolation=cv2.INTER_CUBIC)


def sobel_edge(mask: Mask) -> Mask:
    """Return the mask's pixels where the Sobel gradient is largest across the edge: its outline.

    Args:
        mask: (h, w) bool.
    """
    image = np.pad(mask, 1).astype(np.float32)
    gx = cv2.Sobel(image, cv2.CV_32F, 1, 0, ksize=3)
    gy = cv2.Sobel(image, cv2.CV_32F, 0, 1, ksize=3)
    return ((np.hypot(gx, gy) > 0) & (image > 0))[1:-1, 1:-1]


def trace(mask: Mask) -> Contour:
    """Return the outer outline of the largest object, in order along it.

    Args:
        mask: (h, w) bool.

    Returns:
        (n, 2) x, y of pixel centres; (0, 2) for an empty mask.
    """
    outlines, _ = cv2.findContours(mask.astype(np.uint8), cv2.RETR_EXTERNAL, cv2.CHAIN_APPROX_NONE)
    if not outlines:
        return np.zeros((0, 2))
    return max(outlines, key=len)[:, 0, :].astype(np.float64)


def smooth(contour: Contour, window: int = 9, degree: int = 2) -> Contour:
    """Return the contour after a moving-window polynomial fit along it (a periodic Savitzky-Golay filter).

    Args:
        contour: (n, 2) closed.
        window: points in the window, odd.
        degree: of the fitted polynomial, per coordinate.
    """
    if len(contour) < window + 2:
        return contour.copy()
    return savgol_filter(contour, window, degree, axis=0, mode="wrap")


def resample(contour: Contour, count: int) -> Contour:
    """Return ``count`` points at equal steps of arc length along the closed contour."""
    closed = np.vstack([contour, contour[:1]])
    steps = np.hypot(*np.diff(closed, axis=0).T)
    along = np.concatenate([[0.0], np.cumsum(steps)])
    wanted = np.linspace(0.0, along[-1], count, endpoint=False)
    return np.column_stack([np.interp(wanted, along, closed[:, i]) for i in (0, 1)])
