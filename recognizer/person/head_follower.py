"""Where the head goes while somebody sways: its place from sample to sample, one fit after the other."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from recognizer.person.head_fit import STEPS, fit
from recognizer.person.head_shoulders import Body

TRUSTED = 0.5  # share of what a fit says that is followed: one picture alone is not that sure
FARTHEST = 1.2  # head heights from the person's place: beyond it something else is followed, or a bow


class HeadFollower:
    """Follows a known head.

    Args:
        body: the person; its size stays.

    Attributes:
        body: the head's place now, of the person's size.
    """

    def __init__(self, body: Body) -> None:
        self.anchor = self.body = body
        self._share = 1.0

    def push(self, grey: np.ndarray) -> Body:
        """Take the next sample's picture, (h, w) uint8; return the head's place in it."""
        found = fit(grey, self.body, first=STEPS - 1)
        x = self.body.x + self._share * (found.x - self.body.x) - self.anchor.x
        y = self.body.y + self._share * (found.y - self.body.y) - self.anchor.y
        inside = min(1.0, FARTHEST * self.anchor.head / (math.hypot(x, y) + 1e-9))
        self.body = dataclasses.replace(self.anchor, x=self.anchor.x + inside * x, y=self.anchor.y + inside * y)
        self._share = TRUSTED
        return self.body


def displacement(before: Body, now: Body) -> np.ndarray:
    """How far a head has moved from one place to another, (2,) float32 right and down [head heights]."""
    return np.array([now.x - before.x, now.y - before.y], np.float32) / np.float32(now.head)
