"""A gesture: its name, what it means to people, and the key frames or the walk that it is written in."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from nao_sim.gestures.key_frames import Cycle, KeyFrame, Walk
from nao_sim.gestures.preparation import prepare
from nao_sim.motion.easing import Easing
from nao_sim.motion.trajectory import Trajectory


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
        return prepare(self, start, speed, amplitude, repetitions, limits).trajectory
