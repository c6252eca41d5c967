"""Where gestures begin and end in a long video: stretches of motion between moments of rest, or between cuts."""

from __future__ import annotations

import math
from collections.abc import Iterator

import numpy as np

from recognizer.tracking import Track
from recognizer.video.samples import Sample

REST_SECONDS = 0.7  # so much stillness ends a gesture
MARGIN_SECONDS = 0.4  # of rest kept before and after
SHORTEST_SECONDS = 0.5  # of motion
LONGEST_SECONDS = 10.0  # then it is cut, so that memory is bounded


class Segmenter:
    """Takes frames one by one and gives the samples of each gesture when it has ended."""

    def __init__(self, fps: float, first_index: int = 0, source: str = "stream") -> None:
        self.watch = Track(fps, first_index, source, find_body=False)
        self._begun: float | None = None
        self._moved = 0.0
        self._shot = -math.inf  # when the shot began

    def push(self, frame: np.ndarray) -> Iterator[list[Sample]]:
        """Take one BGR frame; yield the samples of the gesture that it ends, if it ends one."""
        seen = len(self.watch.regions) and self.watch.regions[-1].time
        self.watch.push(frame)
        if not self.watch.regions or self.watch.regions[-1].time == seen:
            return
        latest = self.watch.regions[-1]
        if self.watch.scene.cut:
            if self._begun is not None:
                yield from self._cut(latest.time)
            self._shot = latest.time
            return
        if latest.area > 0:
            self._begun = latest.time if self._begun is None else self._begun
            self._moved = latest.time
        if self._begun is not None:
            rested = latest.time - self._moved >= REST_SECONDS
            if rested or latest.time - self._begun >= LONGEST_SECONDS:
                yield from self._cut()

    def finish(self) -> Iterator[list[Sample]]:
        """Yield the gesture that the end of the video cuts off, if there is one."""
        if self._begun is not None:
            yield from self._cut()

    def _cut(self, until: float = math.inf) -> Iterator[list[Sample]]:
        assert self._begun is not None
        begun, self._begun = self._begun, None
        if self._moved - begun >= SHORTEST_SECONDS:
            first, last = max(begun - MARGIN_SECONDS, self._shot), self._moved + MARGIN_SECONDS
            yield [sample for sample in self.watch.samples if first <= sample.time <= last and sample.time < until]
