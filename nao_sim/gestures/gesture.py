"""What a gesture is: named key frames, and what they mean to people."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from nao_sim.motion.easing import Easing
from nao_sim.motion.trajectory import Trajectory

TORSO_KEYS = ("pitch", "roll", "height")

LONGEST_S = 300.0
"""Seconds that a gesture may last unless it says otherwise: what lasts longer is mostly in another unit of time."""

MOST_REPETITIONS = 100
"""Of a cycle."""

LATEST_FOLLOW_S = 1.0
"""Greatest follow-through, seconds."""


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


@dataclass(frozen=True)
class Gesture:
    """A gesture that the robot can perform.

    Attributes:
        name: label, as the recogniser says it.
        number: the thesis's number within the family; None for what the thesis does not have.
        family: ``static``, ``small``, ``large``, ``game`` or ``own``.
        kind: ``posture``, ``cyclic`` or ``linear``.
        communicative_class: appendix 2 of the thesis: ``symbolic``, ``interactional``, ``pointing`` or ``none``.
        title: one line for people.
        mirror: name of the gesture that this one is with left and right exchanged.
        key_frames: in order of time; empty for a walk.
        easing: how joints get from one to the next.
        follow_through_s: how much later than its parent each arm joint moves, seconds.
        cycle: the repeated part, or None.
        amplitude_joints: the joints that amplitude scales; empty: all but the hands.
        walk: the displacement of a walking gesture, or None.
        longest_s: seconds it may last as written, repetitions included.
        notes: for people: what reading its file took for granted or left out.
    """

    name: str
    number: int | None
    family: str
    kind: str
    communicative_class: str
    title: str
    mirror: str
    key_frames: tuple[KeyFrame, ...] = ()
    easing: Easing = "minimum_jerk"
    follow_through_s: float = 0.0
    cycle: Cycle | None = None
    amplitude_joints: tuple[str, ...] = ()
    walk: Walk | None = None
    longest_s: float = LONGEST_S
    notes: tuple[str, ...] = ()

    @property
    def joints(self) -> tuple[str, ...]:
        """Names of the joints that some key frame names, in order of first appearance."""
        return tuple(dict.fromkeys(name for frame in self.key_frames for name in frame.angles_rad))

    @property
    def duration_s(self) -> float | None:
        """Seconds as written, repetitions included; None for a walk, whose steps decide."""
        if not self.key_frames:
            return None
        marked = {frame.mark: frame.time_s for frame in self.key_frames}
        again = 0.0
        if self.cycle is not None:
            again = (self.cycle.repetitions - 1) * (marked[self.cycle.last] - marked[self.cycle.first])
        return self.key_frames[-1].time_s + again

    def trajectory(
        self,
        start: str | Mapping[str, float] = "StandInit",
        speed: float = 1.0,
        amplitude: float = 1.0,
        repetitions: int | None = None,
        limits: str = "thesis",
    ) -> Trajectory:
        """Return what the robot must do; see :func:`nao_sim.gestures.preparation.prepare`."""
        from nao_sim.gestures.preparation import prepare  # preparation is built on this class

        return prepare(self, start, speed, amplitude, repetitions, limits).trajectory
