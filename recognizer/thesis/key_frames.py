"""Key frames by histogram intersection (thesis ch. 2 (1-1), eq. 1; S8)."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import cv2
import numpy as np

from recognizer.video.histograms import grey_histogram, histogram_intersection

LAG = 3  # x of eq. 1: samples between the two histograms, 0.3 s
GROUP = 5  # the best of each group of 5 or 6 local maxima is kept


def intersection_curve(images: Sequence[np.ndarray], lag: int = LAG) -> np.ndarray:
    """Intersection of each grey image with the one ``lag`` away (before it at the clip's end), (n,)."""
    histograms = [grey_histogram(image) for image in images]
    n = len(histograms)
    lag = min(lag, n - 1)
    return np.array(
        [histogram_intersection(histograms[i], histograms[i + lag if i + lag < n else i - lag]) for i in range(n)]
    )


def local_maxima(curve: np.ndarray) -> np.ndarray:
    """Indices that are higher than the value before and not lower than the one after."""
    inner = (curve[1:-1] > curve[:-2]) & (curve[1:-1] >= curve[2:])
    return np.flatnonzero(inner) + 1


def key_frames(images: Sequence[np.ndarray], lag: int = LAG, group: int = GROUP) -> np.ndarray:
    """Return indices of the key frames: the highest of each group of local maxima.

    A clip with fewer than two of them is given its two ends as well, so that a pair can always be chosen.

    Args:
        images: grey images, two at least.
        lag: x of eq. 1, in images.
        group: number of local maxima of which one is kept.
    """
    curve = intersection_curve(images, lag)
    maxima = local_maxima(curve)
    # Fewer maxima than two groups: smaller groups, so that the clip still yields several key frames.
    group = max(1, min(group, len(maxima) // 3))
    chosen = [
        int(part[np.argmax(curve[part])]) for part in (maxima[i : i + group] for i in range(0, len(maxima), group))
    ]
    if len(chosen) < 2:
        chosen += [0, len(images) - 1]
    return np.unique(chosen)


def least_correlated_pair(images: Sequence[np.ndarray]) -> tuple[int, int]:
    """Return the positions (i < j) of the two images with the lowest correlation."""
    flat = np.stack([np.asarray(image, np.float32).ravel() for image in images])
    flat -= flat.mean(axis=1, keepdims=True)
    norm = np.linalg.norm(flat, axis=1)
    norm[norm == 0] = 1.0
    flat /= norm[:, None]
    correlation = flat @ flat.T
    correlation[np.tril_indices(len(flat))] = np.inf
    first, second = np.unravel_index(int(np.argmin(correlation)), correlation.shape)
    return int(first), int(second)


def equal_motion_frames(images: Sequence[np.ndarray], count: int = 6) -> np.ndarray:
    """Cut a large gesture into parts of equal change: ``count`` indices, first and last image included (S13).

    Args:
        images: grey images in order.
        count: number of key frames; 6 give the thesis's 5 states.
    """
    change = [0.0]
    for before, after in itertools.pairwise(images):
        difference = cv2.absdiff(before, after)
        change.append(float(cv2.mean(difference, (difference > 12).astype(np.uint8))[0]) + 1e-3)
    along = np.cumsum(change)
    return np.searchsorted(along, np.linspace(0, along[-1] * (1 - 1e-9), count)).clip(0, len(images) - 1)
