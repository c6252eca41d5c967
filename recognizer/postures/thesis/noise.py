"""The two kinds of noise of a skin mask (S2; thesis chapter 1 (2-1)).

Type 1 is background taken for skin: small components are removed by size, thin bridges by an opening.
Type 2 is skin taken for background: small holes in the hand or face are filled by size.
Sizes are fractions of the picture's area, so that every resolution is treated alike.
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.postures.types import Mask


def remove_small(mask: Mask, min_fraction: float = 0.003) -> Mask:
    """Remove 8-connected components smaller than ``min_fraction`` of the picture (noise of type 1).

    Args:
        mask: (h, w) bool.
        min_fraction: area of the smallest component kept, over the picture's area.
    """
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    keep = np.zeros(count, bool)
    keep[1:] = stats[1:, cv2.CC_STAT_AREA] >= min_fraction * mask.size
    return keep[labels]


def fill_holes(mask: Mask, max_fraction: float = 0.002) -> Mask:
    """Fill 4-connected holes smaller than ``max_fraction`` of the picture (noise of type 2).

    Background that touches the picture's border is never a hole.

    Args:
        mask: (h, w) bool.
        max_fraction: area of the largest hole filled, over the picture's area; larger ones (a ring) stay.
    """
    count, labels, stats, _ = cv2.connectedComponentsWithStats((~mask).astype(np.uint8), connectivity=4)
    height, width = mask.shape
    left, top = stats[:, cv2.CC_STAT_LEFT], stats[:, cv2.CC_STAT_TOP]
    inside = (left > 0) & (top > 0)
    inside &= (left + stats[:, cv2.CC_STAT_WIDTH] < width) & (top + stats[:, cv2.CC_STAT_HEIGHT] < height)
    fill = inside & (stats[:, cv2.CC_STAT_AREA] < max_fraction * mask.size)
    fill[0] = False  # label 0 is the mask itself
    return mask | fill[labels] if count > 1 else mask.copy()


def open_mask(mask: Mask, radius: float) -> Mask:
    """Open with a disc: noise that hangs on a hand by less than ``2 radius`` pixels is cut off (type 1, larger)."""
    size = 2 * round(radius) + 1
    if size < 3:
        return mask.copy()
    disc = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (size, size))
    return cv2.morphologyEx(mask.astype(np.uint8), cv2.MORPH_OPEN, disc) > 0


def clean(mask: Mask, min_fraction: float = 0.003, max_hole_fraction: float = 0.002) -> Mask:
    """Remove noise of both types."""
    return fill_holes(remove_small(mask, min_fraction), max_hole_fraction)
