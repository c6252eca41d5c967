"""When each frame was taken: the file's own time stamps, or the steady rate of its header where they agree with it."""

from __future__ import annotations

import math

import numpy as np

ASSUMED_FPS = 25.0  # used when nothing says a rate
LONGEST_GAP = 3600.0  # s between two frames; a longer one is a time stamp gone wrong


class FrameClock:
    """Turns the time stamps of frames, as they come, into seconds from the first frame.

    While they agree with the rate of the header to within half a frame, the rate itself is the time, so that rounded
    time stamps (Matroska's are whole milliseconds) make no difference. From the first that does not, the file's stamps
    count: phones film at uneven rates, and screen recorders write a frame only where something changes. A stamp that
    is missing, or not after the one before, is taken to be one period late.

    Args:
        fps: frames per second that the header says; None where nothing is said, then stamps alone count.
    """

    def __init__(self, fps: float | None) -> None:
        self._fps = fps
        self._period = 1 / (fps or ASSUMED_FPS)
        self._steady = fps is not None
        self._number = -1
        self._time = self._told = 0.0
        self._stamp = self._raw = math.nan

    def __call__(self, stamp: float | None = None) -> float:
        """Return the time of the next frame.

        Args:
            stamp: its time stamp [s], of any origin; None or NaN when there is none.

        Returns:
            Seconds from the first frame, each larger than the one before.
        """
        stamp = math.nan if stamp is None else stamp
        self._number += 1
        if self._number:
            step = self._step(stamp)
            self._time += step
            self._stamp = self._stamp + step
        else:
            self._stamp = stamp
        self._raw = stamp
        nominal = self._number * self._period if self._fps is None else self._number / self._fps
        self._steady = self._steady and abs(self._time - nominal) <= 0.5 * self._period
        # Where they part, the half frame in which they still agreed must not make time run backwards.
        time = nominal if self._steady else max(self._time, self._told + 1e-3 * self._period)
        self._told = time if self._number else 0.0
        return self._told

    def _step(self, stamp: float) -> float:
        """Seconds since the frame before."""
        if math.isnan(self._stamp):
            self._stamp = stamp - self._period
        step = stamp - self._stamp
        if 0 < step <= LONGEST_GAP:
            return step
        # One stamp gone wrong costs nothing; stamps that begin anew, as of files put together, are followed from there.
        anew = stamp - self._raw
        if 0 < anew <= LONGEST_GAP:
            self._stamp = self._raw
            return anew
        return self._period


def rate_of(stamps: list[float]) -> float | None:
    """Frames per second that the time stamps of consecutive frames [s] tell, None when they tell none."""
    steps = np.diff(stamps)
    steps = steps[np.isfinite(steps) & (steps > 0)]
    return float(1 / np.median(steps)) if len(steps) and 2 * len(steps) >= len(stamps) - 1 else None
