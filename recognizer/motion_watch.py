"""The network's numbers of each step while frames arrive, so that at the end of a clip little is left to do."""

from __future__ import annotations

from collections import deque

import numpy as np

from recognizer.motion_net import BRIGHTEST, FEATURES, REST, Look, MotionNet
from recognizer.window import Step


class MotionWatch:
    """Watches steps, and what they would be in the mirrored clip, with :class:`recognizer.motion_net.MotionNet`.

    Args:
        kept: how many steps; those before the last ``kept`` are forgotten.
    """

    def __init__(self, kept: int) -> None:
        self._net = MotionNet.load()
        self._rows: deque[np.ndarray] = deque(maxlen=kept)
        self._first: list[Step] = []
        self._rest: np.ndarray | None = None

    def push(self, step: Step) -> None:
        """Take the next step; the first few wait until rest is known."""
        if self._rest is not None:
            self._look(step, self._rest)
            return
        self._first.append(step)
        if len(self._first) == REST:
            self._rest = np.mean([first.picture.clip(-BRIGHTEST, BRIGHTEST) for first in self._first], axis=0)
            for first in self._first:
                self._look(first, self._rest)
            self._first.clear()

    def _look(self, step: Step, rest: np.ndarray) -> None:
        look = Look.of(step, rest)
        self._rows.append(self._net.steps([look, look.mirrored()]))

    @property
    def features(self) -> np.ndarray:
        """(2, 128) of the clip and of the mirrored one; 0 before there were three steps."""
        if not self._rows:
            return np.zeros((2, FEATURES), np.float32)
        return self._net.clips(np.stack(self._rows, axis=1))
