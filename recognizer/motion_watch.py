"""The network's numbers of each step while frames arrive, so that at the end of a clip little is left to do."""

from __future__ import annotations

from collections import deque

import numpy as np

from recognizer.motion_net import FEATURES, REST, Layer, Look, MotionNet
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
        self._rows: deque[np.ndarray] = deque(maxlen=kept)
        self._waiting: list[list[Look]] = []
        self._first: Layer | None = None

    def push(self, step: Step) -> None:
        """Take the next step; the first few wait until rest is known."""
        look = Look.of(step)
        self._waiting.append([look, look.mirrored()] if self._mirrored else [look])
        if self._first is None:
            if len(self._waiting) < REST:
                return
            rest = np.mean([[look.picture for look in looks] for looks in self._waiting], axis=0)
            self._first = self._net.first(rest)
        self._rows.extend(self._net.steps(looks, self._first) for looks in self._waiting)
        self._waiting.clear()

    @property
    def features(self) -> np.ndarray:
        """(2, 128) of the clip and of the mirrored one if it was watched, else 0; 0 before there were three steps."""
        features = np.zeros((2, FEATURES), np.float32)
        if self._rows:
            found = self._net.clips(np.stack(self._rows, axis=1))
            features[: len(found)] = found
        return features
