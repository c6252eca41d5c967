"""A plain background as a smooth colour surface: the hand is what departs from it, whatever the skin and light.

This stands in where the skin box of eq. 1 fails: very dark or bright skin, coloured light, a skin-coloured wall.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.postures.types import Floats, Image, Mask

BORDER = 0.06  # of the shorter side: the frame of pixels from which the surface starts
STRIDE = 3
FEWEST = 30  # border pixels that a surface may rest on
OUTLIER = 3.5  # robust standard deviations
LIGHTNESS_WEIGHT = 0.35  # a shadow changes lightness more than colour


@dataclass(frozen=True)
class Departure:
    """How far each pixel is from the background surface."""

    distance: Floats  # (h, w) in robust standard deviations
    plainness: float  # share of the border, lower edge apart, that the surface explains
    spread: float  # Lab units: robust standard deviation of what it explains


def departure(bgr: Image, iterations: int = 6) -> Departure:
    """Fit L, a and b as quadratic polynomials of x and y (vignetting included), re-fitting without outliers.

    Args:
        bgr: (h, w, 3) uint8.
        iterations: refits; the first ones see only the border.
    """
    colours = cv2.cvtColor(bgr.astype(np.float32) / 255, cv2.COLOR_BGR2LAB)
    height, width = bgr.shape[:2]
    edge = max(2, round(BORDER * min(height, width)))
    border = np.ones((height, width), bool)
    border[edge:, edge:-edge] = False  # not the lower edge, where an arm enters
    # A smooth surface needs no more than every third pixel.
    lab, frame = colours[::STRIDE, ::STRIDE].reshape(-1, 3), border[::STRIDE, ::STRIDE].ravel()
    terms = _quadratic(height, width)
    basis = terms[::STRIDE, ::STRIDE].reshape(-1, 6)
    used = frame.copy()
    for turn in range(iterations):
        coefficients = np.linalg.lstsq(basis[used], lab[used], rcond=None)[0]
        residual = lab - basis @ coefficients
        spread = 1.4826 * np.median(np.abs(residual[used & frame]), axis=0) + 0.5
        inliers = _length(residual, spread) < OUTLIER
        wanted = inliers & frame if turn < 2 else inliers
        if (wanted & frame).sum() < FEWEST:
            break
        used = wanted
    distance = _length(colours - terms @ coefficients, spread)
    return Departure(distance, float((distance[border] < OUTLIER).mean()), float(np.linalg.norm(spread)))


def _length(residual: np.ndarray, spread: np.ndarray) -> np.ndarray:
    return np.sqrt(((residual / spread) ** 2) @ np.array([LIGHTNESS_WEIGHT, 1.0, 1.0]))


def _quadratic(height: int, width: int) -> Floats:
    y, x = np.mgrid[-1 : 1 : height * 1j, -1 : 1 : width * 1j]
    return np.stack([np.ones_like(x), x, y, x * x, x * y, y * y], axis=-1)


def foreground(found: Departure) -> Mask:
    """Return the pixels beyond the threshold that best divides the departures in two (Otsu's, on their logarithm)."""
    scaled = np.clip(np.log1p(found.distance) * 40, 0, 255).astype(np.uint8)
    threshold, _ = cv2.threshold(scaled, 0, 255, cv2.THRESH_BINARY + cv2.THRESH_OTSU)
    return (scaled > threshold) & (found.distance > OUTLIER)
