"""What a gesture is written in: key frames, a part that is repeated, or a displacement on foot."""

# ruff: noqa: D102 (what Written asks for is described where it is held, in Gesture)

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Protocol

from nao_sim.motion.easing import Easing

TORSO_KEYS = ("pitch", "roll", "height")


@dataclass(frozen=True)
class KeyFrame:
    """Where some joints, and perhaps the torso, are at one moment; what is not named passes through.

    Attributes:
        time_s: seconds from the start of the gesture.
        angles_rad: NAOqi joint name → angle in rad (hands: fraction open).
        torso: ``pitch`` and ``roll`` of the torso in the world, rad, 0 upright; ``height`` above its height in
            StandInit, m. The legs that this takes are found by whole-body inverse kinematics.
        rest: every joint of the gesture is back in StandInit.
        mark: a name for this moment.
    """

    time_s: float
    angles_rad: Mapping[str, float] = field(default_factory=dict)
    torso: Mapping[str, float] = field(default_factory=dict)
    rest: bool = False
    mark: str | None = None


@dataclass(frozen=True)
class Cycle:
    """The part that is repeated: from the key frame marked ``first`` to the one marked ``last``, the same pose."""

    first: str
    last: str
    repetitions: int


@dataclass(frozen=True)
class Walk:
    """A displacement on foot, in the robot's own frame: x forward and y left, m; turn to the left, rad."""

    x: float = 0.0
    y: float = 0.0
    turn: float = 0.0


class Written(Protocol):
    """What must be known of a gesture to turn it into a trajectory; see :class:`nao_sim.gestures.gesture.Gesture`."""

    @property
    def name(self) -> str: ...
    @property
    def joints(self) -> tuple[str, ...]: ...
    @property
    def key_frames(self) -> tuple[KeyFrame, ...]: ...
    @property
    def easing(self) -> Easing: ...
    @property
    def follow_through_s(self) -> float: ...
    @property
    def cycle(self) -> Cycle | None: ...
    @property
    def amplitude_joints(self) -> tuple[str, ...]: ...
    @property
    def walk(self) -> Walk | None: ...
