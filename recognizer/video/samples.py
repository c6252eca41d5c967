"""Frames at one steady rate: what makes the recogniser independent of the camera's frame rate and size."""

from __future__ import annotations

import dataclasses
import math
from collections import deque
from collections.abc import Iterator

import cv2
import numpy as np

RATE = 10.0  # samples per second: the slowest camera we promise to understand
LOOK_RATE = 30.0  # frames per second looked at for quick small motion, where the camera gives as many
LOOKS = round(LOOK_RATE / RATE)
KEPT_SECONDS = 12.0  # the ring's length; memory does not grow beyond it
HELD_AFTER = 0.25  # s without a frame, in a source of uneven rate: until the next one the last is still what is seen
IMAGE_SIDE = 480  # px, longer side of the pictures kept for key frames and evidence
FLOW_SIDE = 96  # px, longer side of the grey image on which the flow is computed


@dataclasses.dataclass(frozen=True)
class Sample:
    """One frame of the steady sequence.

    Attributes:
        index: frame number in the source.
        time: seconds from the first frame.
        image: (h, w, 3) uint8 BGR, longer side at most 480 px.
        grey: (h, w) uint8, the same in grey.
        small: (h', w') float32 grey, longer side 96 px.
        looks: time and grey picture of every frame since the sample before, this one last; at most 30 a second.
    """

    index: int
    time: float
    image: np.ndarray
    grey: np.ndarray
    small: np.ndarray
    looks: tuple[tuple[float, np.ndarray], ...]


def scaled_size(width: int, height: int, side: int) -> tuple[int, int]:
    """Return (width, height) scaled so that the longer side is ``side``."""
    scale = side / max(width, height)
    return max(1, round(width * scale)), max(1, round(height * scale))


class _Grid:
    """Steady moments, and whether a frame is the nearest to the next of them.

    At a steady rate frames are counted, so that rounded times make no difference; otherwise times are compared.

    Args:
        rate: moments a second.
        fps: frames per second of a steady source; None when only times count.
    """

    def __init__(self, rate: float, fps: float | None) -> None:
        self._period = 1 / rate
        self._fps = fps
        self._frames = max(1.0, fps / rate) if fps else 1.0  # from one moment to the next
        self._taken = 0
        self._due = 0.0  # s

    def take(self, number: int, time: float, step: float, steady: bool) -> bool:
        """Whether frame ``number`` at ``time``, ``step`` seconds after the one before, is on the grid."""
        # A frame of an uneven source is on the grid where the next one would be farther from it.
        early = min(step, self._period) / 2
        on = number >= round(self._taken * self._frames) if steady else time >= self._due - early
        if on:
            self._taken += 1
            even = (
                min(self._taken * self._frames / self._fps, time + self._period) if steady and self._fps else math.inf
            )
            self.begin(even if steady else self._after(time))
        return on

    def pass_by(self, number: int, time: float, steady: bool) -> None:
        """Count a frame that was taken for another reason."""
        if steady:
            self._taken = max(self._taken, int(number / self._frames) + 1)
        self.begin(self._after(time))

    def begin(self, due: float) -> None:
        """Let the next moment be ``due`` [s]."""
        self._due = due

    def _after(self, time: float) -> float:
        """The first moment of the grid that is not about now."""
        return max(self._due + self._period, time + self._period / 2) if time >= self._due - self._period else self._due


class Sampler:
    """Picks, as frames arrive, those nearest to a steady grid of 10 samples a second, and keeps the last ones.

    A slower camera gives every frame it has; what follows divides by the true time step. Where a file has no frame for
    a while because nothing changed, what was seen last goes on being seen, as on a player's screen.

    Args:
        fps: frames per second; None when every frame comes with its time.
        first_index: number of the first frame in its source.
        seconds: of samples that are kept.
    """

    def __init__(self, fps: float | None, first_index: int = 0, seconds: float = KEPT_SECONDS) -> None:
        self.fps = fps
        self.kept = max(2, int(seconds * RATE))
        self.samples: deque[Sample] = deque(maxlen=self.kept)
        self.pushed = 0
        self.time = -math.inf  # s, of the last frame
        self.first_index = first_index
        self._steady = fps is not None
        self._grid = _Grid(RATE, fps)
        self._look_grid = _Grid(LOOK_RATE, fps)
        self._looks: list[tuple[float, np.ndarray]] = []

    def feed(self, frame: np.ndarray, time: float | None = None) -> Iterator[Sample]:
        """Take one BGR frame; yield the samples that it makes due, those of a gap before it included.

        Args:
            frame: (h, w, 3) uint8.
            time: seconds from the first frame, see :class:`FrameClock`; None at a steady rate.
        """
        if time is not None and self.samples:
            yield from self._held(time)
        sample = self.push(frame, time)
        if sample is not None:
            yield sample

    def push(self, frame: np.ndarray, time: float | None = None) -> Sample | None:
        """Take one BGR frame; return a sample when this frame is on the grid; arguments as of :meth:`feed`."""
        number = self.pushed
        self.pushed += 1
        if self.fps is not None:
            nominal = number / self.fps
            time = nominal if time is None else time
            self._steady = self._steady and time == nominal
        assert time is not None, "a source without a rate needs the time of each frame"
        step, self.time = time - self.time, time
        if not self._grid.take(number, time, step, self._steady):
            if self._look_grid.take(number, time, step, self._steady):
                self._looks.append((time, _limited(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY))))
            return None
        image = _limited(frame)
        if image is frame:
            image = frame.copy()
        grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
        self._look_grid.pass_by(number, time, self._steady)
        small = _small(grey, frame.shape[1], frame.shape[0])
        return self._sample(self.first_index + number, time, image, grey, small)

    def _sample(self, index: int, time: float, image: np.ndarray, grey: np.ndarray, small: np.ndarray) -> Sample:
        looks, self._looks = (*self._looks, (time, grey)), []
        sample = Sample(index, time, image, grey, small, looks)
        self.samples.append(sample)
        return sample

    def _held(self, until: float) -> Iterator[Sample]:
        """Samples of what goes on being seen in a gap before a frame at ``until``; the ring's length at most."""
        steady = self._steady and self.fps is not None and until == self.pushed / self.fps
        if steady or until - self.time <= HELD_AFTER:
            return
        last = self.samples[-1]
        grey, small = last.grey, last.small
        if self._looks:
            grey = self._looks[-1][1]
            small = _small(grey, grey.shape[1], grey.shape[0])
        count = min(math.ceil((until - self.time) * RATE - 1e-6) - 1, self.kept)
        for k in range(count, 0, -1):
            yield self._sample(last.index, until - k / RATE, last.image, grey, small)
        self._grid.begin(until)


def _small(grey: np.ndarray, width: int, height: int) -> np.ndarray:
    """The grey picture, float32, on which the flow is computed, of a frame of ``width`` × ``height`` px."""
    picture = cv2.resize(_halved(grey), scaled_size(width, height, FLOW_SIDE), interpolation=cv2.INTER_AREA)
    return picture.astype(np.float32)


def _halved(grey: np.ndarray) -> np.ndarray:
    """A picture of half the size, which is quickly made, where that is still more than the flow needs."""
    height, width = grey.shape
    if height % 2 or width % 2 or max(height, width) < 2 * FLOW_SIDE:
        return grey
    return cv2.resize(grey, (width // 2, height // 2), interpolation=cv2.INTER_AREA)


def _limited(picture: np.ndarray) -> np.ndarray:
    """A picture whose longer side is at most IMAGE_SIDE: itself, or shrunk."""
    height, width = picture.shape[:2]
    if max(height, width) <= IMAGE_SIDE:
        return picture
    return cv2.resize(picture, scaled_size(width, height, IMAGE_SIDE), interpolation=cv2.INTER_AREA)
