"""A gesture on the robot: prepared from where it stands, played, logged."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np

from nao_sim.gestures.errors import GestureError
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import KeyFrame
from nao_sim.gestures.preparation import REST, prepare
from nao_sim.motion import Change, MotionLog, Trajectory, check, perform
from nao_sim.motion.getting_up import get_up, stands
from nao_sim.motion.perform import Progress
from nao_sim.motion.walking import WalkPlan, plan_walk, walk
from nao_sim.robot import ACTUATED, Nao, posture

# A walk starts from StandInit; a joint this far from it is brought home first.
_AT_HOME_RAD = 0.02


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

    A robot that does not stand gets up first (:func:`nao_sim.motion.getting_up.get_up`), and the log has both. If it
    cannot, the gesture is not begun: the log is that of the attempts and ``log.fallen`` is true.

    Args:
        nao: the robot.
        gesture: what to do.
        speed, amplitude, repetitions: see :func:`nao_sim.gestures.preparation.written`. A walk keeps its own pace and
            is not repeated; its amplitude is how far it goes.
        progress: called with (periods done, periods in all).

    Raises:
        GestureError: the gesture cannot be prepared so.
        MotionError: a walk further than the engine goes.
        RobotError: the simulation became unstable.
    """
    if gesture.walk is None:
        # What cannot be prepared is refused before the robot moves at all.
        prepare(gesture, speed=speed, amplitude=amplitude, repetitions=repetitions, limits=nao.limits)
    if stands(nao):
        return _act(nao, gesture, speed, amplitude, repetitions, progress)
    rising = get_up(nao, progress=progress)
    if rising.fallen:
        return Performance(Trajectory(rising.time, rising.targets), [], rising)
    done = _act(nao, gesture, speed, amplitude, repetitions, progress)
    return replace(done, log=_after(rising, done.log))


def _act(
    nao: Nao, gesture: Gesture, speed: float, amplitude: float, repetitions: int | None, progress: Progress | None
) -> Performance:
    """Perform a gesture; the robot stands."""
    if gesture.walk is not None:
        return _walk(nao, gesture, speed, amplitude, repetitions, progress)
    prepared = prepare(gesture, setpoint_of(nao), speed, amplitude, repetitions, nao.limits)
    check(prepared.trajectory, nao.limits)
    return Performance(prepared.trajectory, prepared.changes, perform(nao, prepared.trajectory, progress=progress))


def motion_of(gesture: Gesture, limits: str = "thesis") -> Trajectory | WalkPlan:
    """Return a gesture's trajectory inside a range set, or the plan of its walk, from StandInit."""
    if gesture.walk is None:
        return gesture.trajectory(limits=limits)
    return plan_walk(gesture.walk.x, gesture.walk.y, gesture.walk.turn)


def setpoint_of(nao: Nao) -> dict[str, float]:
    """Return what the motors are told now, by joint, rad (hands: open fraction)."""
    return dict(zip(ACTUATED, nao.setpoint.tolist(), strict=True))


def _walk(
    nao: Nao, gesture: Gesture, speed: float, amplitude: float, repetitions: int | None, progress: Progress | None
) -> Performance:
    """Walk, after coming home if the last gesture left the robot elsewhere; the log has both."""
    if speed != 1.0 or repetitions not in (None, 1) or gesture.walk is None:
        raise GestureError(f"'{gesture.name}' is a walk and keeps its own pace; leave speed and repetitions out")
    before = come_home(nao)
    goal = gesture.walk
    log = walk(nao, amplitude * goal.x, amplitude * goal.y, amplitude * goal.turn, progress=progress)
    if before is not None:
        log = _after(before, log)
    return Performance(Trajectory(log.time, log.targets), [], log)


def at_home(setpoint: Mapping[str, float]) -> bool:
    """Whether every joint is told to be where it is in StandInit, within a degree or so."""
    home = posture(REST)
    return all(abs(value - home[name]) < _AT_HOME_RAD for name, value in setpoint.items())


def come_home(nao: Nao) -> MotionLog | None:
    """Bring every joint to StandInit; None if they are there."""
    home = posture(REST)
    angles = {name: home[name] for name in ACTUATED if not any(part in name for part in ("Hip", "Knee", "Ankle"))}
    if at_home(setpoint_of(nao)):
        return None
    homing = Gesture("home", None, "own", "linear", "none", "home", "home", (KeyFrame(1.0, angles),))
    return perform(nao, prepare(homing, setpoint_of(nao), limits=nao.limits).trajectory)


def _after(first: MotionLog, then: MotionLog) -> MotionLog:
    """Return two logs as one."""
    joined: dict[str, Any] = {
        entry.name: np.concatenate([getattr(first, entry.name), getattr(then, entry.name)[1:]])
        for entry in fields(MotionLog)
        if isinstance(getattr(first, entry.name), np.ndarray)
    }
    joined["time"] = np.concatenate([first.time, first.time[-1] + then.time[1:]])
    later = None if then.fell_at is None else then.fell_at + float(first.time[-1])
    fell_at = later if first.fell_at is None else first.fell_at
    return replace(first, **joined, fallen=fell_at is not None, fell_at=fell_at)
