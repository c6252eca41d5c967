"""Difference images and the ellipse vector (thesis ch. 2 (1-2) … (1-4), eq. 2-6; S9, S10)."""

from __future__ import annotations

import dataclasses

import cv2
import numpy as np

THRESHOLD = 24  # grey levels; difference above it is motion
MIN_COMPONENT = 0.001  # of the image's area; smaller components are undesired details
SECOND_HAND = 0.35  # a second region counts as a hand from this share of the first one's size

VECTOR_NAMES = ("x1", "y1", "x2", "y2", "sx1", "sy1", "sx2", "sy2", "dx", "dy", "i1", "i2")


@dataclasses.dataclass(frozen=True)
class Ellipse:
    """One moving region: centre of motion, mean absolute deviation (fractions of the image), intensity 0…1."""

    x: float
    y: float
    sx: float
    sy: float
    intensity: float
    area: float


def difference_image(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """Subtract two grey key frames, filter, threshold and drop small components.

    Returns:
        (h, w) uint8: the absolute difference where it is motion, 0 elsewhere.
    """
    difference = cv2.medianBlur(cv2.absdiff(first, second), 5)
    binary = (difference > THRESHOLD).astype(np.uint8)
    _, labels, stats, _ = cv2.connectedComponentsWithStats(binary)
    keep = stats[:, cv2.CC_STAT_AREA] >= MIN_COMPONENT * binary.size
    keep[0] = False
    return np.where(keep[labels], difference, 0).astype(np.uint8)


def ellipses(difference: np.ndarray) -> list[Ellipse]:
    """Describe the one or two moving regions of a difference image, the larger first.

    Regions are components of the closed image, so that the two halves that one hand leaves (where it was,
    where it is) become one; a second region counts when it is not much smaller than the first.
    """
    height, width = difference.shape
    reach = max(3, round(0.06 * min(height, width))) | 1
    closed = cv2.dilate((difference > 0).astype(np.uint8), np.ones((reach, reach), np.uint8))
    count, labels = cv2.connectedComponents(closed)
    weight = np.bincount(labels.ravel(), difference.ravel(), count)
    weight[labels[0, 0] if count == 1 else 0] = 0
    order = [int(i) for i in np.argsort(weight)[::-1] if weight[i] > 0][:2]
    if len(order) == 2 and weight[order[1]] < SECOND_HAND * weight[order[0]]:
        order = order[:1]
    return [_ellipse(np.where(labels == i, difference, 0)) for i in order]


def _ellipse(d: np.ndarray) -> Ellipse:
    """Eq. 2, 3 and 4 of one region; coordinates relative to the image."""
    height, width = d.shape
    total = float(d.sum())
    columns, rows = d.sum(axis=0) / total, d.sum(axis=1) / total
    x_axis, y_axis = (np.arange(width) + 0.5) / width, (np.arange(height) + 0.5) / height
    x, y = float(columns @ x_axis), float(rows @ y_axis)
    sx, sy = float(columns @ np.abs(x_axis - x)), float(rows @ np.abs(y_axis - y))
    return Ellipse(x, y, sx, sy, total / (255.0 * d.size), float((d > 0).mean()))


def ellipse_vector(regions: list[Ellipse]) -> np.ndarray:
    """Eq. 5 and 6: the 12 elements; the second hand is zero when absent, all are zero without motion."""
    none = Ellipse(0, 0, 0, 0, 0, 0)
    a, b = ([*regions, none, none])[:2]
    return np.array(
        [a.x, a.y, b.x, b.y, a.sx, a.sy, b.sx, b.sy, abs(a.x - b.x), abs(a.y - b.y), a.intensity, b.intensity]
    )
