"""One joint's keys against time, as motion files have them: straight lines between, or cubic Bezier curves."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory

Array = NDArray[np.float64]

# Points of a Bezier piece on the way to even spacing: the error is far below a thousandth of a degree.
_FINE = 32


@dataclass(frozen=True, eq=False)
class Curve:
    """The keys of one joint.

    Attributes:
        times: seconds, increasing, shape (k,).
        values: rad (hands: fraction open), shape (k,).
        handles: of cubic Bezier curves, offsets in seconds and rad from each key to the handle before and the handle
            after it, shape (k, 2, 2); None: straight lines.
    """

    times: Array
    values: Array
    handles: Array | None = None

    def straight(self, period: float = CONTROL_PERIOD) -> Curve:
        """Return the curve as straight lines; Bezier pieces become lines of at most ``period`` seconds."""
        if self.handles is None or len(self.times) < 2:
            return Curve(self.times, self.values)
        times, values = [self.times[:1]], [self.values[:1]]
        for index in range(len(self.times) - 1):
            at = np.linspace(self.times[index], self.times[index + 1], self._pieces(index, period) + 1)[1:]
            times.append(at)
            values.append(np.append(self._bezier(index, at[:-1]), self.values[index + 1]))
        return Curve(np.concatenate(times), np.concatenate(values))

    def _pieces(self, index: int, period: float) -> int:
        return max(1, int(np.ceil((self.times[index + 1] - self.times[index]) / period - 1e-9)))

    def _bezier(self, index: int, at: Array) -> Array:
        """Return the values of one piece at times inside it."""
        assert self.handles is not None
        t0, t3 = self.times[index : index + 2]
        v0, v3 = self.values[index : index + 2]
        after, before = self.handles[index, 1], self.handles[index + 1, 0]
        # Handles that reach beyond their piece would let time run backwards; NAOqi's own exports stay inside.
        t1, t2 = (float(np.clip(t, t0, t3)) for t in (t0 + after[0], t3 + before[0]))
        share = np.linspace(0.0, 1.0, _FINE * len(at) + _FINE + 1)
        rest = 1.0 - share
        weights = np.stack([rest**3, 3 * rest**2 * share, 3 * rest * share**2, share**3])
        return np.interp(at, [t0, t1, t2, t3] @ weights, [v0, v0 + after[1], v3 + before[1], v3] @ weights)


def curves_of(trajectory: Trajectory) -> dict[str, Curve]:
    """Return a trajectory's joints as curves; times count from its first sample."""
    times = trajectory.times - trajectory.times[0]
    return {name: Curve(times, trajectory.targets[:, column]) for column, name in enumerate(trajectory.names)}


def union_of_times(curves: Mapping[str, Curve]) -> Array:
    """Return all times at which some joint has a key, seconds, shape (n,)."""
    return np.unique(np.concatenate([curve.times for curve in curves.values()]))


def rows_of(curves: Mapping[str, Curve], times: Array, period: float = CONTROL_PERIOD) -> Array:
    """Return the values of all curves at times, shape (n, joints); NaN outside a joint's own keys."""
    rows = np.full((len(times), len(curves)), np.nan)
    for column, curve in enumerate(curves.values()):
        line = curve.straight(period)
        inside = (times >= line.times[0] - 1e-9) & (times <= line.times[-1] + 1e-9)
        rows[inside, column] = np.interp(times[inside], line.times, line.values)
    return rows
