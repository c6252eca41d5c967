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
    """An angle beyond its joint's range; the message has the range set, and which other sets would allow it."""

    def __init__(self, joint: str, value_rad: float, low_rad: float, high_rad: float, limits: str = "thesis") -> None:
        from nao_sim.robot.tolerance import sets_allowing, tell_apart  # it stands on the joint table, which raises us

        unit = "(open fraction)" if joint.endswith("Hand") else "rad"
        value, low, high = tell_apart(value_rad, low_rad, high_rad, least=4)
        others = [name for name in sets_allowing(joint, value_rad) if name != limits]
        mend = f"stay inside, or ask for limits '{others[0]}', which allow it" if others else "stay inside"
        super().__init__(f"{joint}: {value} is outside [{low}, {high}] {unit} of the limits '{limits}'; {mend}")
        self.joint = joint
        self.limits = limits
        self.value_rad = value_rad
        self.low_rad = low_rad
        self.high_rad = high_rad


class SceneError(RobotError, ValueError):
    """A scene in which the robot cannot be found, or cannot begin."""


class TargetError(RobotError, ValueError):
    """Targets that are not finite numbers, or not as many as there are joints."""


class UnstableError(RobotError):
    """The simulation left the realm of finite numbers."""


class RenderError(RobotError):
    """No picture can be made on this machine."""
