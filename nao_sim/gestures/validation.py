"""A gesture, or a user's file, tried on the robot and held against what the body allows."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nao_sim.errors import NaoSimError
from nao_sim.gestures.act import act
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.library import find_gesture
from nao_sim.gestures.preparation import written
from nao_sim.motion import Change, MotionLog, Trajectory, check, fit, perform
from nao_sim.motion.measures import Criteria, Measures, measure
from nao_sim.robot import Nao

# A walking robot's centre of mass leaves the standing foot on purpose, and its joints follow corrections.
WALKING = Criteria(com_margin_mm=-np.inf, tracking_deg=5.0)


@dataclass(frozen=True, eq=False)
class Validation:
    """What became of one gesture.

    Attributes:
        name: as asked.
        faults: what is wrong; empty: it passes.
        changes: what fitting changed.
        measures, trajectory: None if it was refused before it could be played.
    """

    name: str
    faults: list[str]
    changes: list[Change]
    measures: Measures | None = None
    trajectory: Trajectory | None = None


def validate_gesture(
    name_or_file: str | Path, limits: str = "thesis", fitted: bool = False, criteria: Criteria | None = None
) -> Validation:
    """Check a gesture as it is written, play it free-standing, and measure.

    Args:
        name_or_file: a library gesture or a file.
        limits: ``"thesis"``, ``"v5"`` or ``"envelope"``.
        fitted: make it fit first and report the changes, instead of refusing it.
        criteria: bounds to pass; None for the library's own, or for a walk :data:`WALKING`.
    """
    name = str(name_or_file)
    try:
        gesture = find_gesture(name_or_file, fitted)
        if gesture.walk is not None:
            return _validate_walk(name, gesture, limits, criteria or WALKING)
        trajectory, changes = _asked(gesture, limits, fitted)
    except NaoSimError as error:
        return Validation(name, [str(error)], [])
    with Nao(limits=limits) as nao:
        log: MotionLog = perform(nao, trajectory)
        measures = measure(nao.model, trajectory, log, limits)
    return Validation(name, (criteria or Criteria()).faults(measures), changes, measures, trajectory)


def _validate_walk(name: str, gesture: Gesture, limits: str, criteria: Criteria) -> Validation:
    with Nao(limits=limits) as nao:
        done = act(nao, gesture)
        measures = measure(nao.model, done.trajectory, done.log, limits)
    return Validation(name, criteria.faults(measures), done.changes, measures, done.trajectory)


def _asked(gesture: Gesture, limits: str, fitted: bool) -> tuple[Trajectory, list[Change]]:
    """Return the motion exactly as written, refused if it asks too much; or fitted, with the changes."""
    trajectory = written(gesture)
    if fitted:
        return fit(trajectory, limits)
    check(trajectory, limits)
    return trajectory, []
