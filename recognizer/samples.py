"""Frames at one steady rate: what makes the recogniser independent of the camera's frame rate and size."""

from __future__ import annotations

import dataclasses
from collections import deque

import cv2
import numpy as np

RATE = 10.0  # samples per second: the slowest camera we promise to understand
KEPT_SECONDS = 15.0  # the ring's length; memory does not grow beyond it
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
    """

    index: int
    time: float
    image: np.ndarray
    grey: np.ndarray
    small: np.ndarray


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
        self.samples: deque[Sample] = deque(maxlen=max(2, int(seconds * min(fps, RATE))))
        self.pushed = 0
        self.first_index = first_index
        self._step = max(1.0, fps / RATE)
        self._taken = 0

    def push(self, frame: np.ndarray) -> Sample | None:
        """Take one BGR frame; return a sample when this frame is on the grid."""
        number = self.pushed
        self.pushed += 1
        if number < round(self._taken * self._step):
            return None
        self._taken += 1
        height, width = frame.shape[:2]
        if max(height, width) > IMAGE_SIDE:
            image = cv2.resize(frame, scaled_size(width, height, IMAGE_SIDE), interpolation=cv2.INTER_AREA)
        else:
            image = frame.copy()
        grey = cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
        small = cv2.resize(grey, scaled_size(width, height, FLOW_SIDE), interpolation=cv2.INTER_AREA)
        sample = Sample(self.first_index + number, number / self.fps, image, grey, small.astype(np.float32))
        self.samples.append(sample)
        return sample
