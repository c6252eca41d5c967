"""The last steps of a clip as arrays that fill while frames arrive.

Stacking a list of them when the clip ends would cost as much as describing the clip; here the end only takes views.
"""

from __future__ import annotations

import dataclasses

import numpy as np

from recognizer.person.steps import Step

_FIELDS = tuple(field.name for field in dataclasses.fields(Step))


class Steps:
    """Keeps the last ``kept`` steps; twice the room, so that they stand in order and seldom move.

    Args:
        kept: how many; one at least.
    """

    def __init__(self, kept: int) -> None:
        self._kept = kept
        self._stacks: dict[str, np.ndarray] = {}
        self._start = self._stop = 0

    def __len__(self) -> int:
        return self._stop - self._start

    def append(self, step: Step) -> None:
        """Add the next step; the oldest goes when there are too many."""
        if self._stop == 2 * self._kept:
            for stack in self._stacks.values():
                stack[: self._kept] = stack[self._kept :]
            self._start, self._stop = 0, self._kept
        for name in _FIELDS:
            value = np.asarray(getattr(step, name))
            if name not in self._stacks:
                self._stacks[name] = np.empty((2 * self._kept, *value.shape), value.dtype)
            self._stacks[name][self._stop] = value
        self._stop += 1
        self._start = max(self._start, self._stop - self._kept)

    def stacked(self, name: str) -> np.ndarray:
        """View of one field of :class:`Step` of all kept steps, (n, …), oldest first."""
        return self._stacks[name][self._start : self._stop]
