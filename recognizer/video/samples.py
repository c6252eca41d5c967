"""Frames at one steady rate: what makes the recogniser independent of the camera's frame rate and size."""

from __future__ import annotations

import dataclasses
from collections import deque

import cv2
import numpy as np

RATE = 10.0  # samples per second: the slowest camera we promise to understand
LOOK_RATE = 30.0  # frames per second looked at for quick small motion, where the camera gives as many
LOOKS = round(LOOK_RATE / RATE)
KEPT_SECONDS = 12.0  # the ring's length; memory does not grow beyond it
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


class Sampler:
    """Picks, as frames arrive, those nearest to a steady grid of 10 samples a second, and keeps the last ones.

    A slower camera gives every frame it has; what follows divides by the true time step.
    """

    def __init__(self, fps: float, first_index: int = 0, seconds: float = KEPT_SECONDS) -> None:
        self.fps = fps
        self.kept = max(2, int(seconds * min(fps, RATE)))
        self.samples: deque[Sample] = deque(maxlen=self.kept)
        self.pushed = 0
        self.first_index = first_index
        self._step = max(1.0, fps / RATE)
        self._taken = 0
        self._look_step = max(1.0, fps / LOOK_RATE)
        self._looks_taken = 0
        self._looks: list[tuple[float, np.ndarray]] = []

    def push(self, frame: np.ndarray) -> Sample | None:
        """Take one BGR frame; return a sample when this frame is on the grid."""
        number = self.pushed
        self.pushed += 1
        if number < round(self._taken * self._step):
            self._look(number, frame)
            return None
        self._taken += 1
        height, width = frame.shape[:2]
        image = _limited(frame)
        if image is frame:
            image = frame.copy()
        grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
        small = cv2.resize(_halved(grey), scaled_size(width, height, FLOW_SIDE), interpolation=cv2.INTER_AREA)
        time = number / self.fps
        looks, self._looks = (*self._looks, (time, grey)), []
        self._looks_taken = max(self._looks_taken, int(number / self._look_step) + 1)
        sample = Sample(self.first_index + number, time, image, grey, small.astype(np.float32), looks)
        self.samples.append(sample)
        return sample

    def _look(self, number: int, frame: np.ndarray) -> None:
        if number < round(self._looks_taken * self._look_step):
            return
        self._looks_taken += 1
        self._looks.append((number / self.fps, _limited(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY))))


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
