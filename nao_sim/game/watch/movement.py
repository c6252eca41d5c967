"""When somebody on a film begins to move, and when they have ended."""

from __future__ import annotations

import itertools
from collections.abc import Sequence

import cv2
import numpy as np
from numpy.typing import NDArray

from recognizer import Evidence

WIDTH_PX = 160
FASTEST_SHARE = 0.01
"""Speed is that of the fastest hundredth of the picture: a hand, not the body that sways."""
OF_PEAK = 0.3
"""A movement begins where speed first passes this share of its peak above rest, and ends where it last does."""
SLOWEST = 0.12
"""Below this peak, picture widths a second, nobody has made a gesture: standing people sway."""


def movement(evidence: Evidence, certain: bool = False) -> tuple[float, float] | None:
    """Find the first and the last moment of movement.

    Args:
        evidence: of the recognition of the film.
        certain: a gesture was recognised, so that somebody moved, however little (a nod).

    Returns:
        Seconds of the film, or None where nobody moves more than a standing person does. Half of the starts are within
        0.1 s of the truth and four of five within 0.35 s (``benchmarks/game.py onset``).
    """
    samples = evidence.samples
    if len(samples) < 2:
        return None
    times = np.array([sample.time for sample in samples])
    speeds = _speeds([sample.grey for sample in samples], np.diff(times))
    if speeds.max() < SLOWEST and not certain:
        return None
    rest = float(np.percentile(speeds, 10))
    moving = np.flatnonzero(speeds > rest + OF_PEAK * (speeds.max() - rest))
    first, last = int(moving[0]), int(moving[-1])
    # A speed belongs to the middle of the step that it was measured over.
    return float((times[first] + times[first + 1]) / 2), float(times[last + 1])


def _speeds(greys: Sequence[NDArray[np.uint8]], seconds: NDArray[np.float64]) -> NDArray[np.float64]:
    """Speed of what moves fastest in each step, picture widths a second, shape (n - 1,)."""
    height = max(1, round(greys[0].shape[0] * WIDTH_PX / greys[0].shape[1]))
    small = [cv2.resize(grey, (WIDTH_PX, height), interpolation=cv2.INTER_AREA) for grey in greys]
    count = max(1, round(FASTEST_SHARE * WIDTH_PX * height))
    speeds = []
    for before, after in itertools.pairwise(small):
        flow = cv2.calcOpticalFlowFarneback(before, after, None, 0.5, 3, 11, 2, 5, 1.1, 0)  # type: ignore[call-overload]
        size = np.sort(np.hypot(flow[..., 0], flow[..., 1]), axis=None)
        # What the whole picture does is the camera's, not the person's.
        speeds.append(float(size[-count:].mean() - np.median(size)))
    return np.array(speeds) / WIDTH_PX / seconds
