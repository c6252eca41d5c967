"""Small or large? Tracking what moves by optical flow and measuring how far it goes (thesis ch. 3, S14)."""

from __future__ import annotations

import dataclasses
import math

import cv2
import numpy as np

SPEED_THRESHOLD = 0.02  # image diagonals per second: slower pixels count as static
MIN_REGION = 0.0015  # of the image's area: smaller moving regions are noise
SMALL_TO_LARGE = 0.12  # image diagonals: the thesis's examples are 0.03 for a wave, 0.31 and 0.31 for large gestures


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


@dataclasses.dataclass(frozen=True)
class Amplitude:
    """How far a gesture goes.

    Attributes:
        family: "small" or "large", by the rule ``rule``.
        rule: "first_to_last" (thesis eq. 5) or "whole_path".
        transition: distance from the first to the last centroid of motion [image diagonals].
        extent: largest distance between two centroids of the path [image diagonals].
        path: (n, 3) time [s], x, y of the centroid [fractions of the image], moving samples only.
    """

    family: str
    rule: str
    transition: float
    extent: float
    path: np.ndarray


def centroid_transition(first: tuple[float, float], last: tuple[float, float]) -> float:
    """Return the distance of two centroids, thesis ch. 3, eq. 5, in the unit of its arguments."""
    return math.hypot(last[0] - first[0], last[1] - first[1])


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


def amplitude(regions: list[MovingRegions], size: tuple[int, int], rule: str = "whole_path") -> Amplitude:
    """Decide small or large from the path of the centroid of motion.

    The thesis compares the first centroid with the last; a circle or a bow with its return ends where it
    began, so ``whole_path`` compares the two centroids that are furthest apart.

    Args:
        regions: moving regions in order of time.
        size: width and height of the image, any unit; only their ratio counts.
        rule: "first_to_last" or "whole_path".
    """
    scale = np.array(size, float) / math.hypot(*size)
    path = np.array([(r.time, *r.centroid) for r in regions if r.area > 0]).reshape(-1, 3)
    points = path[:, 1:] * scale
    if len(points) < 2:
        return Amplitude("small", rule, 0.0, 0.0, path)
    transition = centroid_transition(tuple(points[0]), tuple(points[-1]))
    extent = float(np.max(np.linalg.norm(points[:, None] - points[None], axis=2)))
    value = transition if rule == "first_to_last" else extent
    return Amplitude("large" if value > SMALL_TO_LARGE else "small", rule, transition, extent, path)
