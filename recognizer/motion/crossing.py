"""Does a thing cross the picture, or somebody who walks? Legs change the outline from step to step, things keep theirs.

Flow cannot tell: a box that is pushed through the picture moves as a walker does. The outline can, from the side and
from afar, where no head is found: its widths from top to bottom, as shares of their mean, are the same in all pictures
of a thing, and go up and down where legs are. Of 43 rendered walkers whose outline could be seen, the least varied by
0.115, and of twelve things that slide the most by 0.023 (`benchmarks/things_that_slide.py`).
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

SIDE = 160  # px, longer side of the pictures compared
BACKGROUND = 25  # pictures whose median is what stands still
LEAST_DIFFERENCE, NOISE = 16.0, 5.0  # grey levels, and deviations of the noise, that make a pixel foreground
LEAST_AREA = 0.002  # share of the picture
ROWS = 16  # of the outline, from top to bottom
LEGS = 9  # rows from here downwards
LEAST_PICTURES = 3  # with the outline off the left and right border
RIGID = 0.05  # variation of the widths below which the outline keeps its shape: between things and walkers
TRAVEL = 0.25  # widths of the picture that the outline must travel for the question to arise


def thing_crosses(images: Sequence[np.ndarray]) -> bool:
    """Whether what moves crosses the picture and keeps its shape; False where no outline can be seen.

    Args:
        images: pictures of one clip in order, (h, w, 3) uint8, all of one size.
    """
    outlines, centres = _outlines(images)
    if len(outlines) < LEAST_PICTURES or np.ptp(centres) < TRAVEL:
        return False
    widths = outlines / outlines.mean(axis=1, keepdims=True)
    variation = widths.std(axis=0) / (widths.mean(axis=0) + 0.02)
    return float(np.median(variation[LEGS:])) < RIGID


def _outlines(images: Sequence[np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    """Widths (n, ROWS) of what stands out from the background [its heights], and its centre (n,) [picture widths]."""
    scale = SIDE / max(images[0].shape[:2])
    small = np.stack(
        [cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) for image in images]
    ).astype(np.float32)
    chosen = np.unique(np.linspace(0, len(small) - 1, BACKGROUND).round().astype(int))
    difference = np.abs(small - np.median(small[chosen], axis=0)).max(axis=3)
    # Most of the picture stands still: the median of the differences is the camera's noise.
    threshold = max(LEAST_DIFFERENCE, NOISE * 2 * 1.4826 * float(np.median(difference)))
    found = [_outline(one > threshold) for one in (cv2.blur(picture, (3, 3)) for picture in difference)]
    seen = [outline for outline in found if outline is not None]
    return np.array([widths for widths, _ in seen]), np.array([centre for _, centre in seen])


def _outline(mask: np.ndarray) -> tuple[np.ndarray, float] | None:
    """Widths and centre of the largest piece of a mask, None where it is small or cut by the left or right border."""
    height, width = mask.shape
    closed = cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_CLOSE, np.ones((max(3, height // 40),) * 2, np.uint8))
    _, labels, stats, _ = cv2.connectedComponentsWithStats(closed)
    if len(stats) < 2:
        return None
    largest = 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))
    x, y, w, h, area = (int(v) for v in stats[largest])
    if area < LEAST_AREA * mask.size or h < ROWS or x <= 1 or x + w >= width - 1:
        return None
    piece = labels[y : y + h, x : x + w] == largest
    widths = [_extent(np.asarray(rows.any(axis=0))) / h for rows in np.array_split(piece, ROWS)]
    return np.array(widths), (x + w / 2) / width


def _extent(columns: np.ndarray) -> float:
    """Columns from the first to the last that is set."""
    where = np.flatnonzero(columns)
    return float(where[-1] - where[0] + 1) if len(where) else 0.0
