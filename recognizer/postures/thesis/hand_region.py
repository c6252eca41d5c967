"""The hand alone: the object with most feature pixels, and the cut that drops the arm (S3, S4; thesis ch. 1 (2-3))."""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.postures.thesis.chamfer import chamfer_distance, feature_pixels, feature_range
from recognizer.postures.types import Floats, Mask


@dataclass(frozen=True)
class Cut:
    """What the cut was made from and what it left, all in the pixels of the picture it was made in."""

    centroid: Floats  # (2,) x, y: C, of the object with its arm (eq. 8)
    fingers_mean: Floats  # (2,) M, mean of the feature pixels above C
    point: Floats  # (2,) P, on the cutting line, which is perpendicular to CM
    hand: Mask  # (h, w) what is left on the side of the fingers
    features: Mask  # (h, w) feature pixels of the object


def most_featured(mask: Mask, erosion: int = 0) -> Mask:
    """Return the object that has most feature pixels: an open hand has more of them than a face or a fist.

    Args:
        mask: (h, w) bool skin mask.
        erosion: radius in pixels by which touching objects are eroded before they are counted; the object is
            grown back afterwards, inside the mask.

    Returns:
        (h, w) bool, all False for an empty mask.
    """
    body: np.ndarray = mask.astype(np.uint8)
    kernel = cv2.getStructuringElement(cv2.MORPH_ELLIPSE, (2 * erosion + 1, 2 * erosion + 1))
    if erosion > 0:
        body = cv2.erode(body, kernel)
    count, labels = cv2.connectedComponents(body, connectivity=8)
    if count < 2:
        return np.zeros_like(mask)
    features = feature_pixels(chamfer_distance(body > 0), *feature_range(mask.shape[0]))
    votes = np.bincount(labels[features], minlength=count)
    areas = np.bincount(labels.ravel(), minlength=count)
    votes[0] = areas[0] = -1
    best = labels == np.lexsort((areas, votes))[-1]  # by feature pixels, then by area
    if erosion > 0:
        best = (cv2.dilate(best.astype(np.uint8), kernel) > 0) & mask
    return best


def centroid(mask: Mask) -> Floats:
    """Return (x̄, ȳ) of the mask's pixels (eq. 8)."""
    moments = cv2.moments(mask.astype(np.uint8), binaryImage=True)
    return np.array([moments["m10"], moments["m01"]]) / max(moments["m00"], 1.0)


def cut_arm(mask: Mask, ratio: float = 0.75) -> Cut:
    """Cut the object by the line through P = C - round(ratio (M - C)), perpendicular to CM (eq. 4, 5).

    Args:
        mask: (h, w) bool, one object: a hand, with or without its arm.
        ratio: the thesis's 0.75.

    Returns:
        the cut. Without a feature pixel above C there is no direction to cut along, and the object stays whole.
    """
    features = mask & feature_pixels(chamfer_distance(mask), *feature_range(mask.shape[0]))
    c = centroid(mask)
    ys, xs = np.nonzero(features)
    above = ys < c[1]
    if not above.any():
        return Cut(c, c.copy(), c.copy(), mask.copy(), features)
    m = np.array([xs[above].mean(), ys[above].mean()])
    p = c - np.round(ratio * (m - c))
    rows, columns = np.indices(mask.shape)
    side = (columns - p[0]) * (m - c)[0] + (rows - p[1]) * (m - c)[1]
    return Cut(c, m, p, largest(mask & (side >= 0)), features)


def largest(mask: Mask) -> Mask:
    """Return the largest 8-connected component."""
    count, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    if count < 2:
        return mask.copy()
    return labels == 1 + int(np.argmax(stats[1:, cv2.CC_STAT_AREA]))


def recentred(mask: Mask) -> Mask:
    """Return the mask moved so that its centroid stands in the middle of a frame that holds all of it."""
    ys, xs = np.nonzero(mask)
    if len(xs) == 0:
        return mask.copy()
    c = np.round(centroid(mask)).astype(int)
    half = 2 + max(np.abs(xs - c[0]).max(), np.abs(ys - c[1]).max())
    frame = np.zeros((2 * half + 1, 2 * half + 1), bool)
    frame[ys - c[1] + half, xs - c[0] + half] = True
    return frame
