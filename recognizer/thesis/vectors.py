"""The thesis's own vectors, kept as a reproducible baseline: those of chapter 2 beside the amplitude of chapter 3.

Small gestures: the least correlated pair of key frames, one 12-element ellipse vector. Large gestures: six key frames,
five consecutive states, 60 elements (S13).
"""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import numpy as np

from recognizer.motion.amplitude import amplitude
from recognizer.motion.moving_regions import MovingRegions
from recognizer.thesis.difference_images import VECTOR_NAMES, difference_image, ellipse_vector, ellipses
from recognizer.thesis.key_frames import equal_motion_frames, key_frames, least_correlated_pair

METHOD = "thesis"
VERSION = 2
STATES = 5
_N = len(VECTOR_NAMES)
NAMES = (
    "transition", "extent", "size",
    *VECTOR_NAMES,
    *(f"state{s}_{name}" for s in range(1, STATES + 1) for name in VECTOR_NAMES),
)  # fmt: skip
SMALL = slice(3, 3 + _N)  # where a vector describes a small gesture …
LARGE = slice(3 + _N, 3 + _N + STATES * _N)  # … and where a large one


def small_pair(greys: list[np.ndarray]) -> tuple[int, int]:
    """Return the two key frames of a small gesture as positions in ``greys``, the earlier first."""
    keys = key_frames(greys)
    i, j = least_correlated_pair([greys[k] for k in keys])
    return int(keys[i]), int(keys[j])


def features(greys: list[np.ndarray], regions: Sequence[MovingRegions]) -> np.ndarray:
    """Return the thesis's vector of a clip, (75,): amplitude, size of the motion, small and large vectors.

    Args:
        greys: pictures of the clip, (h, w) uint8 each, two at least.
        regions: what moves in all of them but the first.
    """
    height, width = greys[0].shape
    routed = amplitude(list(regions), (width, height), "first_to_last")
    i, j = small_pair(greys)
    difference = difference_image(greys[i], greys[j])
    states = equal_motion_frames(greys, STATES + 1)
    large = [ellipse_vector(ellipses(difference_image(greys[a], greys[b]))) for a, b in itertools.pairwise(states)]
    size = float((difference > 0).mean())
    return np.concatenate([[routed.transition, routed.extent, size], ellipse_vector(ellipses(difference)), *large])
