"""What moves in a picture: regions of the optical flow that are fast and large enough (thesis ch. 3 (2), S14)."""

from __future__ import annotations

import dataclasses
import math

import cv2
import numpy as np

SPEED_THRESHOLD = 0.02  # image diagonals per second: slower pixels count as static
MIN_REGION = 0.0015  # of the image's area: smaller moving regions are noise


@dataclasses.dataclass(frozen=True)
class MovingRegions:
    """What moves in one sample.

    Attributes:
        time: seconds.
        boxes: (n, 4) x, y, width, height of each moving region, as fractions of the image.
        centroid: (x, y) of all moving regions as fractions of the image; NaN when nothing moves.
        area: share of the image that moves.
        velocity: mean velocity of what moves [image widths, image heights per second].
        sides: how many of the image's four borders move for most of their length.
    """

    time: float
    boxes: np.ndarray
    centroid: tuple[float, float]
    area: float
    velocity: tuple[float, float] = (0.0, 0.0)
    sides: int = 0


def moving_mask(u: np.ndarray, v: np.ndarray, seconds: float) -> np.ndarray:
    """Binary image of what moves: velocity threshold, median filter, closing (thesis ch. 3 (2)).

    Args:
        u: (h, w) velocity right [px per step].
        v: (h, w) velocity down [px per step].
        seconds: duration of the step.

    Returns:
        (h, w) uint8, 255 where something moves.
    """
    height, width = u.shape
    threshold = SPEED_THRESHOLD * math.hypot(width, height) * seconds
    mask = (u * u + v * v > threshold * threshold).astype(np.uint8) * 255
    mask = cv2.medianBlur(mask, 3)
    return cv2.morphologyEx(mask, cv2.MORPH_CLOSE, np.ones((3, 3), np.uint8))


def moving_regions(u: np.ndarray, v: np.ndarray, time: float, seconds: float) -> MovingRegions:
    """Box the connected regions of what moves, dropping those too small; arguments as :func:`moving_mask`."""
    mask = moving_mask(u, v, seconds)
    height, width = mask.shape
    _, _, stats, centres = cv2.connectedComponentsWithStats(mask)
    keep = [i for i in range(1, len(stats)) if stats[i, cv2.CC_STAT_AREA] >= max(3, MIN_REGION * mask.size)]
    if not keep:
        return MovingRegions(time, np.zeros((0, 4)), (math.nan, math.nan), 0.0)
    areas = stats[keep, cv2.CC_STAT_AREA].astype(float)
    x, y = (centres[keep] * areas[:, None]).sum(axis=0) / areas.sum()
    boxes = stats[keep, :4] / np.array([width, height, width, height], float)
    centroid = ((x + 0.5) / width, (y + 0.5) / height)
    velocity = (cv2.mean(u, mask)[0] / width / seconds, cv2.mean(v, mask)[0] / height / seconds)
    return MovingRegions(time, boxes, centroid, float(areas.sum() / mask.size), velocity, _moving_sides(mask))


def _moving_sides(mask: np.ndarray) -> int:
    band = max(1, min(mask.shape) // 12)
    borders = (mask[:band], mask[-band:], mask[:, :band], mask[:, -band:])
    return sum(2 * cv2.countNonZero(border) > border.size for border in borders)
