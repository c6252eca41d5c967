"""What can go wrong with the robot, each error naming the joint or file and the mend."""

from __future__ import annotations

from collections.abc import Iterable

from nao_sim.errors import NaoSimError, did_you_mean


class RobotError(NaoSimError):
    """Base of the robot's errors."""


class UnknownNameError(RobotError, LookupError):
    """A joint, chain, posture, camera or variant that the robot does not have."""

    def __init__(self, kind: str, name: str, known: Iterable[str]) -> None:
        super().__init__(f"NAO has no {kind} '{name}'{did_you_mean(name, known)}")
        self.kind = kind
        self.name = name


class AngleRangeError(RobotError, ValueError):
    """An angle beyond its joint's range."""

    def __init__(self, joint: str, value_rad: float, low_rad: float, high_rad: float) -> None:
        unit = "(open fraction)" if joint.endswith("Hand") else "rad"
        super().__init__(f"{joint}: {value_rad:.4f} is outside [{low_rad:.4f}, {high_rad:.4f}] {unit}; stay inside")
        self.joint = joint
        self.value_rad = value_rad
        self.low_rad = low_rad
        self.high_rad = high_rad


class TargetError(RobotError, ValueError):
    """Targets that are not finite numbers, or not as many as there are joints."""


class UnstableError(RobotError):
    """The simulation left the realm of finite numbers."""


class RenderError(RobotError):
    """No picture can be made on this machine."""
