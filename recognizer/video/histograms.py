"""Histograms of grey pictures, and how far two of them agree (thesis ch. 2 (1-1), eq. 1)."""

from __future__ import annotations

import cv2
import numpy as np

BINS = 64


def grey_histogram(image: np.ndarray, bins: int = BINS) -> np.ndarray:
    """Histogram of a grey image, uint8 or float32, (bins,) float32, sums to the number of pixels."""
    return cv2.calcHist([image], [0], None, [bins], [0, 256]).ravel()


def histogram_intersection(first: np.ndarray, second: np.ndarray) -> float:
    """Eq. 1: Σ min(H(i), H(i±x)) / Σ H(i), 1 for equal histograms and 0 for disjoint ones."""
    return float(np.minimum(first, second).sum() / first.sum())
