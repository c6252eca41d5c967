"""The network's numbers of each step while frames arrive, so that at the end of a clip little is left to do."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import numpy as np

from recognizer.convolution import Layer
from recognizer.motion_net import FEATURES, REST, Look, MotionNet
from recognizer.window import Step


class MotionWatch:
    """Watches steps with :class:`recognizer.motion_net.MotionNet`.

    Args:
        kept: how many steps; those before the last ``kept`` are forgotten.
        mirrored: watch what they would be in the mirrored clip, too.
    """

    def __init__(self, kept: int, mirrored: bool = False) -> None:
        self._net = MotionNet.load()
        self._mirrored = mirrored
        self._rows: deque[tuple[np.ndarray, ...]] = deque(maxlen=kept)
        self._waiting: list[list[Look]] = []
        self._first: list[Layer] = []

    def push(self, steps: Sequence[Step]) -> None:
        """Take the next steps, several at once in less time; the first few wait until rest is known."""
        looks = [Look.of(step) for step in steps]
        self._waiting += [[look, look.mirrored()] if self._mirrored else [look] for look in looks]
        if len(self._waiting) < (1 if self._first else REST):
            return
        if not self._first:
            rest = np.mean([[look.picture for look in looks] for looks in self._waiting[:REST]], axis=0)
            self._first = [self._net.first(picture) for picture in rest]
        persons = zip(zip(*self._waiting, strict=True), self._first, strict=True)
        found = [self._net.steps(looks, first) for looks, first in persons]
        self._rows.extend(zip(*found, strict=True))
        self._waiting.clear()

    @property
    def features(self) -> np.ndarray:
        """(2, 128) of the clip and of the mirrored one if it was watched, else 0; 0 before there were three steps."""
        features = np.zeros((2, FEATURES), np.float32)
        if self._rows:
            found = self._net.clips(np.stack(self._rows, axis=1))
            features[: len(found)] = found
        return features
