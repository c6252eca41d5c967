"""Errors of motions: each names the joint, the time and the bound."""

from __future__ import annotations

from nao_sim.errors import NaoSimError


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
    """

    def __init__(self, joint: str, time_s: float, asked: float, bounds: tuple[float, float], unit: str = "deg") -> None:
        self.joint, self.time_s, self.asked, self.bounds, self.unit = joint, time_s, asked, bounds, unit
        super().__init__(
            f"{joint} is asked for {asked:.2f} {unit} at {time_s:.2f} s, its range is "
            f"{bounds[0]:.2f} .. {bounds[1]:.2f} {unit}; keep inside it or pass --fit"
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
