"""A gesture on the robot: prepared from where it stands, played, logged."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.gestures.errors import GestureError
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.preparation import prepare
from nao_sim.motion import Change, MotionLog, Trajectory, check, perform
from nao_sim.motion.perform import Progress
from nao_sim.robot import ACTUATED, Nao


@dataclass(frozen=True, eq=False)
class Performance:
    """What was played and what came of it; ``changes`` is what the motors needed changed."""

    trajectory: Trajectory
    changes: list[Change]
    log: MotionLog


def act(
    nao: Nao,
    gesture: Gesture,
    *,
    speed: float = 1.0,
    amplitude: float = 1.0,
    repetitions: int | None = None,
    progress: Progress | None = None,
) -> Performance:
    """Perform a gesture from where the robot's set-points are now.

    Args:
        nao: a robot that stands.
        gesture: what to do.
        speed, amplitude, repetitions: see :func:`nao_sim.gestures.preparation.prepare`.
        progress: called with (periods done, periods in all).

    Raises:
        GestureError: the gesture cannot be prepared so.
        RobotError: the simulation became unstable.
    """
    if gesture.walk is not None:
        raise GestureError(f"'{gesture.name}' is a walk, and this version does not walk yet; choose another gesture")
    start = dict(zip(ACTUATED, nao.setpoint, strict=True))
    prepared = prepare(gesture, start, speed, amplitude, repetitions, nao.limits)
    check(prepared.trajectory, nao.limits)
    return Performance(prepared.trajectory, prepared.changes, perform(nao, prepared.trajectory, progress=progress))
