"""A trajectory: targets for the 25 actuated joints against time, and what may be done with it."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.errors import MotionError
from nao_sim.robot.joints import ACTUATED

CONTROL_PERIOD = 0.02  # seconds between set-points, as on the robot (thesis, appendix 1)


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Set-points of every actuated joint, linear in time between samples.

    Attributes:
        times: seconds from the start, strictly increasing, shape (n,), first 0.
        targets: rad (hands: fraction open, 0 … 1), shape (n, 25), columns as ``names``.
        names: NAOqi joint names of the columns; always :data:`nao_sim.robot.ACTUATED`.
        marks: named moments in seconds, such as the start of a held pose (``{"hold": 1.2}``).

    Raises:
        MotionError: shapes disagree, times are not increasing, or a value is not finite.
    """

    times: NDArray[np.float64]
    targets: NDArray[np.float64]
    names: tuple[str, ...] = tuple(ACTUATED)
    marks: dict[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        times = np.array(self.times, dtype=float)
        targets = np.array(self.targets, dtype=float)
        if targets.shape != (len(times), len(self.names)):
            raise MotionError(f"targets have shape {targets.shape}, want ({len(times)}, {len(self.names)})")
        if len(times) == 0 or not (np.isfinite(times).all() and np.isfinite(targets).all()):
            raise MotionError("a trajectory needs at least one sample, all of them finite numbers")
        if (np.diff(times) <= 0).any():
            at = float(times[1:][np.diff(times) <= 0][0])
            raise MotionError(f"times must increase; they do not at {at:.3f} s")
        times.flags.writeable = targets.flags.writeable = False
        object.__setattr__(self, "times", times)
        object.__setattr__(self, "targets", targets)

    @property
    def duration(self) -> float:
        """Seconds from the first sample to the last."""
        return float(self.times[-1] - self.times[0])

    def sample(self, at: float | NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the targets at one time, shape (25,), or at many, shape (m, 25); held outside the trajectory."""
        moments = np.atleast_1d(np.asarray(at, dtype=float))
        after = np.clip(np.searchsorted(self.times, moments, side="right"), 1, max(len(self.times) - 1, 1))
        if len(self.times) == 1:
            picked = np.repeat(self.targets, len(moments), axis=0)
        else:
            t0, t1 = self.times[after - 1], self.times[after]
            share = np.clip((moments - t0) / (t1 - t0), 0.0, 1.0)[:, None]
            picked = (1.0 - share) * self.targets[after - 1] + share * self.targets[after]
        return picked[0] if np.ndim(at) == 0 else picked

    def resampled(self, period: float = CONTROL_PERIOD) -> Trajectory:
        """Return the same motion at a fixed period, seconds; the last sample holds the last target."""
        steps = int(np.ceil(self.duration / period - 1e-9))
        times = np.asarray(np.arange(steps + 1) * period, dtype=np.float64)
        return Trajectory(times, self.sample(self.times[0] + times), self.names, dict(self.marks))

    def speeds(self) -> NDArray[np.float64]:
        """Return |speed| of each joint in each interval, rad/s (hands 1/s), shape (n - 1, 25)."""
        return np.abs(np.diff(self.targets, axis=0)) / np.diff(self.times)[:, None]

    def columns(self, names: list[str] | tuple[str, ...]) -> NDArray[np.float64]:
        """Return the targets of some joints, shape (n, len(names))."""
        return self.targets[:, [self.names.index(name) for name in names]]


def joined(*parts: Trajectory) -> Trajectory:
    """Return the parts one after another; each starts one control period after the last sample of the one before."""
    times: list[NDArray[np.float64]] = []
    start = 0.0
    marks: dict[str, float] = {}
    for part in parts:
        times.append(part.times - part.times[0] + start)
        marks |= {name: at + start for name, at in part.marks.items()}
        start = float(times[-1][-1]) + CONTROL_PERIOD
    return Trajectory(np.concatenate(times), np.concatenate([part.targets for part in parts]), marks=marks)
