"""The part of a clip in which the person moves, cut into phases of equal duration."""

from __future__ import annotations

import dataclasses
import functools

import numpy as np

from recognizer.features.step_history import Steps

PHASES = 5  # as many as the thesis's consecutive states
TRIMMED = (0.01, 0.985)  # share of all motion that begins and ends the active part


@dataclasses.dataclass(frozen=True)
class Active:
    """The steps of a clip as arrays, with its active part.

    Attributes:
        u, v, speed, ways, torso: as in :class:`Step`, (n, …).
        head: (n, 2, h, w) velocity in the window HEAD.
        pictures: (n, h, w) windows with even contrast.
        poses: (n, h, w) uint8 windows POSE.
        places: (n, 2) of the head [head heights].
        seconds: (n,) duration of each step.
        first, last: steps first … last-1 are active.
        phases: (5, n) seconds that each step contributes to each phase.
        moved: mean motion of the whole clip [head heights].
    """

    u: np.ndarray
    v: np.ndarray
    speed: np.ndarray
    ways: np.ndarray
    head: np.ndarray
    torso: np.ndarray
    pictures: np.ndarray
    poses: np.ndarray
    places: np.ndarray
    seconds: np.ndarray
    first: int
    last: int
    phases: np.ndarray
    moved: float

    @functools.cached_property
    def period(self) -> float:
        """Typical duration of a step [s]."""
        return float(np.median(self.seconds))


def active_part(steps: Steps) -> Active:
    """Find the active part of a clip's steps: where all but the first and last per cent of the motion happens."""
    flow, speed = steps.stacked("flow"), steps.stacked("speed")
    seconds = steps.stacked("seconds").astype(np.float32)
    moved = speed.mean(axis=(1, 2)) * seconds
    total = float(moved.sum())
    along = np.cumsum(moved) / (total + 1e-6)
    n = len(steps)
    last = min(int(np.searchsorted(along, TRIMMED[1])) + 1, n)
    first = min(int(np.searchsorted(along, TRIMMED[0])), last - 1)
    return Active(
        flow[:, 0],
        flow[:, 1],
        speed,
        steps.stacked("ways"),
        steps.stacked("head_flow"),
        steps.stacked("torso"),
        steps.stacked("picture"),
        steps.stacked("pose"),
        steps.stacked("place"),
        seconds,
        first,
        last,
        _phases(first, last, n) * seconds,
        total,
    )


def _phases(first: int, last: int, n: int) -> np.ndarray:
    """Share of each step in each phase, (5, n)."""
    edges = np.linspace(first, last, PHASES + 1)
    step = np.arange(n)
    overlap = np.minimum(step + 1, edges[1:, None]) - np.maximum(step, edges[:-1, None])
    return overlap.clip(0, 1).astype(np.float32)
