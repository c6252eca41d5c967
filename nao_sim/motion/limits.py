"""May the robot do it: range and speed of a trajectory, checked, fitted, or given more time."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.ndimage import maximum_filter1d, uniform_filter1d

from nao_sim.motion.errors import RangeExceeded, SpeedExceeded
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.robot.joints import ACTUATED, joint_table
from nao_sim.robot.tolerance import SOFTNESS_RAD, sets_allowing, tell_apart

HANDS = ("LHand", "RHand")
# A trajectory made to be just as fast as its motors must not fail its own check on rounding.
TOLERANCE = 1e-6
# Slowing down and speeding up again is spread over this many control periods, so that it is not a jolt.
_BLEND_PERIODS = 15
_MOST_PASSES = 6


@dataclass(frozen=True)
class Bounds:
    """What the joints may do.

    Attributes:
        range_rad: lower and upper target, rad (hands fraction), shape (25, 2).
        speed: nominal speed of each motor at its joint, rad/s (hands 1/s), shape (25,).
        acceleration: how fast set-points gain speed, rad/s², shape (25,).
    """

    range_rad: NDArray[np.float64]
    speed: NDArray[np.float64]
    acceleration: NDArray[np.float64]


@dataclass(frozen=True)
class Change:
    """One thing that fitting changed: a joint clipped to its range, or time added to a stretch of the motion.

    Attributes:
        joint, time_s: whose and when it is worst, seconds.
        asked, bound: what the motion asked for and what the joint does: degrees, degrees a second, degrees a second
            squared (hands: fractions).
        what: ``"angle"``, ``"speed"`` or ``"acceleration"``; the last two got more time.
    """

    joint: str
    time_s: float
    asked: float
    bound: float
    what: str

    @property
    def takes_time(self) -> bool:
        """Whether the motion takes more time for it; otherwise it goes less far."""
        return self.what != "angle"

    @property
    def unit(self) -> str:
        """The unit of ``asked`` and ``bound``."""
        unit, _ = unit_of(self.joint)
        if not self.takes_time:
            return unit
        unit = "1" if unit == "fraction" else unit
        return f"{unit}/s" if self.what == "speed" else f"{unit}/s²"

    def __str__(self) -> str:
        asked, bound, _ = tell_apart(self.asked, self.bound, self.bound)
        how = f"{self.what} {asked} → {bound} {self.unit}" + (", takes more time" if self.takes_time else "")
        return f"{self.joint} at {self.time_s:.2f} s: {how}"


def bounds(limits: str = "thesis") -> Bounds:
    """Return the bounds of the actuated joints.

    Args:
        limits: ``"thesis"`` for table A1-1, ``"v5"`` for the narrower NAO V5 document.
    """
    table = joint_table().select(ACTUATED)
    acceleration = np.array([joint.acceleration for joint in table.joints])
    return Bounds(table.range_rad(limits), table.max_speed_rad(), acceleration)


def unit_of(joint: str) -> tuple[str, float]:
    """Return the unit that files and messages use for a joint, and the factor from rad (or fraction) to it."""
    return ("fraction", 1.0) if joint in HANDS else ("deg", float(np.rad2deg(1.0)))


def check(trajectory: Trajectory, limits: str = "thesis") -> None:
    """Refuse a trajectory that leaves a range or outruns a motor.

    Raises:
        RangeExceeded: a target is outside its joint's range; names the joint that is furthest out.
        SpeedExceeded: a target moves faster than the motor's nominal speed; names the worst joint.
    """
    bound = bounds(limits)
    excess = np.maximum(bound.range_rad[:, 0] - trajectory.targets, trajectory.targets - bound.range_rad[:, 1])
    if excess.max() > SOFTNESS_RAD:
        row, column = np.unravel_index(np.argmax(excess), excess.shape)
        unit, scale = unit_of(trajectory.names[column])
        low, high = bound.range_rad[column] * scale
        raise RangeExceeded(
            trajectory.names[column],
            float(trajectory.times[row]),
            float(trajectory.targets[row, column] * scale),
            (float(low), float(high)),
            unit,
            limits,
            tuple(
                name
                for name in sets_allowing(trajectory.names[column], float(trajectory.targets[row, column]))
                if name != limits
            ),
        )
    if len(trajectory.times) < 2:
        return
    ratio = trajectory.speeds() / bound.speed
    if ratio.max() > 1.0 + TOLERANCE:
        row, column = np.unravel_index(np.argmax(ratio), ratio.shape)
        unit, scale = unit_of(trajectory.names[column])
        asked, most = ratio[row, column] * bound.speed[column] * scale, bound.speed[column] * scale
        shown = "deg/s" if unit == "deg" else "1/s"
        raise SpeedExceeded(trajectory.names[column], float(trajectory.times[row]), float(asked), float(most), shown)


def clipped(trajectory: Trajectory, limits: str = "thesis") -> tuple[Trajectory, list[Change]]:
    """Return the trajectory inside every range, and for each joint that was outside where it was furthest out."""
    bound = bounds(limits)
    inside = np.clip(trajectory.targets, bound.range_rad[:, 0], bound.range_rad[:, 1])
    changes = []
    for column, name in enumerate(trajectory.names):
        excess = np.abs(trajectory.targets[:, column] - inside[:, column])
        row = int(np.argmax(excess))
        if excess[row] > SOFTNESS_RAD:
            _, scale = unit_of(name)
            asked, got = trajectory.targets[row, column] * scale, inside[row, column] * scale
            changes.append(Change(name, float(trajectory.times[row]), float(asked), float(got), "angle"))
    return Trajectory(trajectory.times, inside, trajectory.names, dict(trajectory.marks)), changes


def stretched(trajectory: Trajectory, limits: str = "thesis", share: float = 0.98) -> tuple[Trajectory, list[Change]]:
    """Give time where a motor could not follow, and only there.

    Intervals are lengthened until no joint moves faster than ``share`` of its nominal speed and its set-points gain
    speed no faster than the command layer lets them; the lengthening is blended in and out over 0.3 s. The result is
    sampled at the control period.

    Returns:
        The trajectory, and one change for each joint that asked for more, at its worst moment.
    """
    bound = bounds(limits)
    even = trajectory.resampled()
    changes = _worst(even, even.speeds() / (share * bound.speed), share * bound.speed, "speed")
    changes += _worst(even, _accelerations(even) / bound.acceleration, bound.acceleration, "acceleration")
    if not changes:
        return even, []
    for _ in range(_MOST_PASSES):
        ratio = asked_over_able(even, share)
        if ratio.max(initial=0.0) <= 1.0 + TOLERANCE:
            break
        even = _dilated(even, ratio.max(axis=1))
    return even, changes


def asked_over_able(even: Trajectory, share: float = 0.98) -> NDArray[np.float64]:
    """Return by how much each interval would have to be longer for its motors, shape (n - 1, 25); up to 1: not at all.

    Args:
        even: a motion sampled at the control period.
        share: of the motors' nominal speed that may be used.
    """
    bound = bounds()
    # Time stretched by s divides speeds by s and accelerations by its square.
    return np.maximum(even.speeds() / (share * bound.speed), np.sqrt(_accelerations(even) / bound.acceleration))


def _accelerations(even: Trajectory) -> NDArray[np.float64]:
    """Return how fast each joint gains speed around each interval, rad/s², shape (n - 1, 25)."""
    speeds = even.speeds()
    gained = np.maximum(np.diff(speeds, axis=0), 0.0) / CONTROL_PERIOD
    still = np.zeros((1, speeds.shape[1]))
    return np.maximum(np.concatenate([gained, still]), np.concatenate([still, gained]))[: len(speeds)]


def _worst(even: Trajectory, ratio: NDArray[np.float64], most: NDArray[np.float64], what: str) -> list[Change]:
    changes = []
    for column in np.flatnonzero(ratio.max(axis=0, initial=0.0) > 1.0 + TOLERANCE):
        row = int(np.argmax(ratio[:, column]))
        allowed = float(most[column] * unit_of(even.names[column])[1])
        asked = float(ratio[row, column]) * allowed
        changes.append(Change(even.names[column], float(even.times[row]), asked, allowed, what))
    return changes


def _dilated(even: Trajectory, ratio: NDArray[np.float64]) -> Trajectory:
    """Return the motion with each interval longer by at least ``ratio``, shape (n - 1,), sampled evenly again."""
    # A maximum filter and then a mean of the same width is smooth and nowhere below the ratio itself.
    factor = uniform_filter1d(maximum_filter1d(np.maximum(ratio, 1.0), _BLEND_PERIODS), _BLEND_PERIODS)
    times = np.concatenate([[0.0], np.cumsum(np.diff(even.times) * factor)])
    marks = {name: float(np.interp(at, even.times, times)) for name, at in even.marks.items()}
    return Trajectory(times, even.targets, even.names, marks).resampled(CONTROL_PERIOD)


def fit(trajectory: Trajectory, limits: str = "thesis") -> tuple[Trajectory, list[Change]]:
    """Return the nearest trajectory that the robot can follow, and a report of what changed (empty: nothing)."""
    inside, clips = clipped(trajectory, limits)
    slower, stretches = stretched(inside, limits)
    return slower, clips + stretches
