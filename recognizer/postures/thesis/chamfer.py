"""Chamfer distance and the feature pixels of a hand (S3; thesis chapter 1 (2-2), eq. 2 and 3)."""

from __future__ import annotations

import numpy as np

from recognizer.postures.types import Floats, Mask

# The 3-4 weights of the classic chamfer metric, divided by 3 so that distances are in pixels.
STRAIGHT = 1.0
DIAGONAL = 4.0 / 3.0
# Eq. 3, in pixels of a picture of 144 rows.
FEATURE_RANGE = (4.0, 12.0)
REFERENCE_ROWS = 144


def chamfer_distance(mask: Mask) -> Floats:
    """Return every pixel's two-pass 3-4 chamfer distance to the background, in pixels.

    What lies beyond the border counts as unknown: a hand cut by the border does not end there.

    Args:
        mask: (h, w) bool.

    Returns:
        (h, w) float64, 0 on the background, inf if there is no background at all.
    """
    distance = np.where(mask, np.inf, 0.0)
    _pass_down(distance)
    flipped = distance[::-1, ::-1]
    _pass_down(flipped)
    return distance


def _pass_down(distance: Floats) -> None:
    """Do the forward pass in place: each pixel against its upper three and its left neighbour.

    The chain along a row, d[x] = min(d[x], d[x-1] + 1), is the running minimum of d[x] - x, plus x.
    """
    steps = np.arange(distance.shape[1]) * STRAIGHT
    for y in range(distance.shape[0]):
        row = distance[y]
        if y > 0:
            above = distance[y - 1]
            np.minimum(row, above + STRAIGHT, out=row)
            np.minimum(row[1:], above[:-1] + DIAGONAL, out=row[1:])
            np.minimum(row[:-1], above[1:] + DIAGONAL, out=row[:-1])
        row[:] = np.minimum.accumulate(row - steps) + steps


def feature_pixels(distance: Floats, low: float = FEATURE_RANGE[0], high: float = FEATURE_RANGE[1]) -> Mask:
    """Return the pixels at least as far from the background as their 8 neighbours (eq. 2), within [low, high] (eq. 3).

    Args:
        distance: (h, w) chamfer distance in pixels.
        low, high: kept distances, pixels. The thesis's 4 and 12 hold for 144 rows; see `feature_range`.
    """
    padded = np.pad(distance, 1, mode="constant", constant_values=-np.inf)
    height, width = distance.shape
    ridge = (distance >= low) & (distance <= high)
    for dy in (0, 1, 2):
        for dx in (0, 1, 2):
            ridge &= distance >= padded[dy : dy + height, dx : dx + width]
    return ridge


def feature_range(rows: int) -> tuple[float, float]:
    """Return the interval of eq. 3 for a picture of that many rows, in pixels."""
    scale = rows / REFERENCE_ROWS
    return FEATURE_RANGE[0] * scale, FEATURE_RANGE[1] * scale
