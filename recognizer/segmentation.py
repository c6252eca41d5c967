"""Where gestures begin and end in a long video: stretches of motion between moments of rest, or between cuts."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator

import numpy as np

from recognizer.motion.moving_regions import MovingRegions
from recognizer.tracking import Track
from recognizer.video.samples import Sample

REST_SECONDS = 0.7  # so much stillness ends a gesture
MARGIN_SECONDS = 0.4  # of rest kept before and after
SHORTEST_SECONDS = 0.5  # of motion
LONGEST_SECONDS = 10.0  # then it is cut, so that memory is bounded


class RestFinder:
    """Takes what moves, sample by sample, and gives from when to when each gesture lasts once it has ended."""

    def __init__(self) -> None:
        self._begun: float | None = None
        self._moved = 0.0
        self._shot = -math.inf  # when the shot began

    def observe(self, latest: MovingRegions, cut: bool = False) -> tuple[float, float] | None:
        """Take the next sample's moving regions; return first and last second of the gesture that has ended.

        Args:
            latest: what moves.
            cut: whether the sample is the first of another shot.
        """
        if cut:
            ended, self._shot = self._end(latest.time), latest.time
            return ended
        if latest.area > 0:
            self._begun = latest.time if self._begun is None else self._begun
            self._moved = latest.time
        if self._begun is None:
            return None
        rested = latest.time - self._moved >= REST_SECONDS
        return self._end() if rested or latest.time - self._begun >= LONGEST_SECONDS else None

    def finish(self) -> tuple[float, float] | None:
        """Return the gesture that the end of the video cuts off, if there is one."""
        return self._end()

    def _end(self, until: float = math.inf) -> tuple[float, float] | None:
        begun, self._begun = self._begun, None
        if begun is None or self._moved - begun < SHORTEST_SECONDS:
            return None
        # A cut's own sample belongs to the next shot.
        last = min(self._moved + MARGIN_SECONDS, math.nextafter(until, -math.inf))
        return max(begun - MARGIN_SECONDS, self._shot), last


class Segmenter:
    """Takes frames one by one and gives the samples of each gesture when it has ended."""

    def __init__(self, fps: float | None, first_index: int = 0, source: str = "stream") -> None:
        self.watch = Track(fps, first_index, source, find_body=False)
        self._rest = RestFinder()

    def push(self, frame: np.ndarray, time: float | None = None) -> Iterator[list[Sample]]:
        """Take one BGR frame; yield the samples of each gesture that it ends; arguments as of :meth:`Track.push`."""
        for sample in self.watch.sampler.feed(frame, time):
            self.watch.take(sample)
            if self.watch.regions:
                yield from self._samples(self._rest.observe(self.watch.regions[-1], self.watch.scene.cut))

    def finish(self) -> Iterator[list[Sample]]:
        """Yield the gesture that the end of the video cuts off, if there is one."""
        yield from self._samples(self._rest.finish())

    def _samples(self, part: tuple[float, float] | None) -> Iterator[list[Sample]]:
        if part is not None:
            yield [sample for sample in self.watch.samples if part[0] <= sample.time <= part[1]]


def only_gesture(regions: Iterable[MovingRegions]) -> tuple[float, float] | None:
    """First and last second of the only gesture in what moves; None when there is none, or more than one."""
    rest = RestFinder()
    found = [*(rest.observe(latest) for latest in regions), rest.finish()]
    parts = [part for part in found if part is not None]
    return parts[0] if len(parts) == 1 else None
