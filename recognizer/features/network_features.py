"""The network's numbers of each step while frames arrive, so that at the end of a clip little is left to do."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

import cv2
import numpy as np

from recognizer.networks.convolution import Layer
from recognizer.networks.motion_net import (
    BRIGHTEST,
    FEATURES,
    FLOW_UNIT,
    HEAD_CELLS,
    PICTURE_UNIT,
    REST,
    Look,
    MotionNet,
)
from recognizer.person.steps import Step
from recognizer.person.view import cell_means


class MotionWatch:
    """Watches steps with :class:`recognizer.networks.motion_net.MotionNet`.

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
        looks = [look_of(step) for step in steps]
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


def look_of(step: Step) -> Look:
    """Bring a step to the network's units."""
    picture = step.picture.clip(-BRIGHTEST, BRIGHTEST) / np.float32(PICTURE_UNIT)
    flow = cell_means(step.flow, 2) / FLOW_UNIT
    flow = np.stack([_root(flow[0]), _root(flow[1]), np.sqrt(np.hypot(*flow))], axis=-1)
    cells = [cv2.resize(f, (HEAD_CELLS, HEAD_CELLS), interpolation=cv2.INTER_AREA).ravel() for f in step.head_flow]
    head = _root(np.concatenate([*cells, step.torso, step.place]))
    return Look(picture, flow, head)


def _root(values: np.ndarray) -> np.ndarray:
    rooted: np.ndarray = np.sign(values) * np.sqrt(np.abs(values))
    return rooted
