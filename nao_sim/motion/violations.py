"""Where a motion leaves its joints' ranges or outruns their motors: every place, not the first alone."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.curves import Curve, curves_of
from nao_sim.motion.limits import HANDS, unit_of
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.robot.joints import joint_table
from nao_sim.robot.tolerance import SOFTNESS_RAD, sets_allowing, tell_apart

Array = NDArray[np.float64]

# A motor may be asked for its nominal speed but for rounding: files are printed with few digits.
_SPEED_SLACK = 1e-4
# A change that is over so soon and is so many times what the motor does in a control period is a step.
_STEP_S, _STEP_TIMES = 0.06, 3.0


@dataclass(frozen=True)
class Violation:
    """One stretch of a motion in which a joint does what it may not.

    Attributes:
        joint: NAOqi's name.
        time_s: when it is worst; it begins at ``from_s`` and ends at ``to_s``.
        value: the angle or speed asked for, in ``unit``.
        bounds: lower and upper bound in the same unit.
        unit: ``deg``, ``fraction`` (hands), ``deg/s`` or ``1/s``.
        limits: the range set that it was held to.
        allowed_by: other range sets that allow it.
        step: of a speed that is over almost at once, by how much the joint is to jump, deg or fraction; otherwise 0.
    """

    joint: str
    time_s: float
    from_s: float
    to_s: float
    value: float
    bounds: tuple[float, float]
    unit: str
    limits: str
    allowed_by: tuple[str, ...] = ()
    step: float = 0.0

    def __str__(self) -> str:
        """One line: joint, time, value, bounds, range set."""
        value, low, high = tell_apart(self.value, *self.bounds, least=1 if "/" in self.unit else 2)
        long = self.to_s - self.from_s > CONTROL_PERIOD
        when = f"{self.time_s:.2f} s" + (f" ({self.from_s:.2f} to {self.to_s:.2f} s)" if long else "")
        if self.step:
            unit = "deg" if self.unit == "deg/s" else "of its opening"
            return (
                f"{self.joint} at {when} steps by {self.step:.3g} {unit}: asked for {value} {self.unit}, its motor "
                f"does {high} {self.unit} and takes {self.step / self.bounds[1]:.2g} s"
            )
        if self.unit.endswith("/s"):
            return f"{self.joint} at {when} is asked for {value} {self.unit}, its motor does {high} {self.unit}"
        beyond = abs(self.value - float(np.clip(self.value, *self.bounds)))
        other = f"; '{self.allowed_by[0]}' allows it" if self.allowed_by else ""
        return (
            f"{self.joint} at {when} is {value}, {beyond:.2g} beyond its '{self.limits}' range "
            f"{low} .. {high} {self.unit}{other}"
        )


def violations(motion: Trajectory | Mapping[str, Curve], limits: str = "thesis") -> list[Violation]:
    """Return every violation of a motion, joint by joint, angles first; empty: it may be done.

    Angles past a range by no more than the joints' own softness count as on the limit. Speeds are those that the
    set-points, one every 20 ms, would ask for: a step within that time is judged as a step.

    Args:
        motion: a trajectory, or the keys of some joints as a file has them (nothing before a joint's first key counts).
        limits: ``"thesis"``, ``"v5"`` or ``"envelope"``.

    Raises:
        UnknownNameError: no such range set.
    """
    return angle_violations(motion, limits) + speed_violations(motion, limits)


def angle_violations(motion: Trajectory | Mapping[str, Curve], limits: str = "thesis") -> list[Violation]:
    """Return where angles are out of range; see :func:`violations`."""
    return [entry for name, curve in _straight(motion).items() for entry in _angles(name, curve, limits)]


def speed_violations(motion: Trajectory | Mapping[str, Curve], limits: str = "thesis") -> list[Violation]:
    """Return where motors would have to be too fast; see :func:`violations`."""
    return [entry for name, curve in _straight(motion).items() for entry in _speeds(name, curve, limits)]


def _straight(motion: Trajectory | Mapping[str, Curve]) -> dict[str, Curve]:
    curves = curves_of(motion) if isinstance(motion, Trajectory) else motion
    return {name: curve.straight() for name, curve in curves.items()}


def _angles(name: str, curve: Curve, limits: str) -> list[Violation]:
    low, high = joint_table().select([name]).range_rad(limits)[0]
    excess = np.maximum(low - curve.values, curve.values - high)
    unit, scale = unit_of(name)
    found = []
    for first, last in _stretches(excess > SOFTNESS_RAD):
        row = first + int(np.argmax(excess[first : last + 1]))
        value = float(curve.values[row])
        others = tuple(other for other in sets_allowing(name, value) if other != limits)
        at, begin, end = (float(curve.times[index]) for index in (row, first, last))
        bounds = float(low * scale), float(high * scale)
        found.append(Violation(name, at, begin, end, value * scale, bounds, unit, limits, others))
    return found


def _speeds(name: str, curve: Curve, limits: str) -> list[Violation]:
    if len(curve.times) < 2:
        return []
    times, speeds = step_speeds(curve)
    most = joint_table()[name].nominal_speed
    unit, scale = ("1/s", 1.0) if name in HANDS else ("deg/s", unit_of(name)[1])
    found = []
    for first, last in _stretches(speeds > most * (1 + _SPEED_SLACK)):
        row = first + int(np.argmax(speeds[first : last + 1]))
        at, begin, end = (float(times[index]) for index in (row, first, last))
        bounds = 0.0, float(most * scale)
        inside = (curve.times >= begin - 1e-9) & (curve.times <= end + CONTROL_PERIOD + 1e-9)
        ends = np.interp([begin, end + CONTROL_PERIOD], curve.times, curve.values)
        jump = float(np.ptp(np.concatenate([curve.values[inside], ends])) * scale)
        step = jump if end - begin <= _STEP_S and jump > _STEP_TIMES * bounds[1] * CONTROL_PERIOD else 0.0
        found.append(Violation(name, at, begin, end, float(speeds[row] * scale), bounds, unit, limits, (), step))
    return found


def step_speeds(curve: Curve) -> tuple[Array, Array]:
    """Return moments, seconds, and the speed that set-points sent then ask for, rad/s, of straight lines.

    A change within one control period counts as made in one: that is what the next set-point asks for, at whatever
    moment within the period it comes.
    """
    steps, rises = np.diff(curve.times), np.abs(np.diff(curve.values))
    moments = np.unique(np.concatenate([curve.times, curve.times - CONTROL_PERIOD]))
    moments = moments[(moments >= curve.times[0] - 1e-9) & (moments < curve.times[-1] - 1e-9)]
    ahead = np.minimum(moments + CONTROL_PERIOD, curve.times[-1])
    change = np.abs(np.interp(ahead, curve.times, curve.values) - np.interp(moments, curve.times, curve.values))
    # A jump there and back within a period leaves no trace in the two ends of it.
    short = steps < CONTROL_PERIOD
    at = np.concatenate([moments, curve.times[:-1][short]])
    speeds = np.concatenate([change, rises[short]]) / CONTROL_PERIOD
    order = np.argsort(at, kind="stable")
    return at[order], speeds[order]


def _stretches(out: NDArray[np.bool_]) -> list[tuple[int, int]]:
    """Return the first and last index of each run of True."""
    edges = np.flatnonzero(np.diff(np.concatenate([[False], out, [False]]).astype(int)))
    return [(int(first), int(last) - 1) for first, last in edges.reshape(-1, 2)]
