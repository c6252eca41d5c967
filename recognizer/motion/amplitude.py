"""Small or large? How far the centroid of what moves goes (thesis ch. 3, eq. 5; S14)."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from recognizer.motion.moving_regions import MovingRegions

SMALL_TO_LARGE = 0.12  # image diagonals: the thesis's examples are 0.03 for a wave, 0.31 and 0.31 for large gestures


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
