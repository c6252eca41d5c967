"""Errors of motions: each names the joint, the time and the bound."""

from __future__ import annotations

from nao_sim.errors import NaoSimError
from nao_sim.robot.tolerance import tell_apart


class MotionError(NaoSimError, ValueError):
    """A motion that cannot be played as asked."""


class RangeExceeded(MotionError):
    """A target lies outside its joint's range.

    Args:
        joint: NAOqi joint name.
        time_s: when, in seconds from the start of the motion.
        asked: the target, degrees (fraction for a hand).
        bounds: lower and upper bound in the same unit.
        unit: ``"deg"`` or ``"fraction"``.
        limits: the range set that has these bounds.
        allowed_by: other range sets that allow it.
    """

    def __init__(
        self,
        joint: str,
        time_s: float,
        asked: float,
        bounds: tuple[float, float],
        unit: str = "deg",
        limits: str = "thesis",
        allowed_by: tuple[str, ...] = (),
    ) -> None:
        self.joint, self.time_s, self.asked, self.bounds, self.unit = joint, time_s, asked, bounds, unit
        self.limits, self.allowed_by = limits, allowed_by
        value, low, high = tell_apart(asked, *bounds)
        other = f", pass --limits {allowed_by[0]}, which allows it," if allowed_by else ""
        super().__init__(
            f"{joint} is asked for {value} {unit} at {time_s:.2f} s, its '{limits}' range is {low} .. {high} {unit}; "
            f"keep inside it{other} or pass --fit"
        )


class SpeedExceeded(MotionError):
    """A target moves faster than the joint's motor nominally turns.

    Args:
        joint: NAOqi joint name.
        time_s: when, in seconds from the start of the motion.
        asked: speed, degrees per second (fractions per second for a hand).
        bound: the motor's nominal speed at the joint, in the same unit.
        unit: ``"deg/s"`` or ``"1/s"``.
    """

    def __init__(self, joint: str, time_s: float, asked: float, bound: float, unit: str = "deg/s") -> None:
        self.joint, self.time_s, self.asked, self.bound, self.unit = joint, time_s, asked, bound, unit
        super().__init__(
            f"{joint} is asked for {asked:.1f} {unit} at {time_s:.2f} s, its motor does {bound:.1f} {unit}; "
            "give it more time or pass --fit"
        )
