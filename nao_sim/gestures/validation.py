"""A gesture, or a user's file, tried on the robot and held against what the body allows."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from nao_sim.gestures.act import act
from nao_sim.gestures.formats import MotionFile, Said, load_motion
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.library import find_gesture, library
from nao_sim.gestures.preparation import written
from nao_sim.motion import Change, MotionLog, Trajectory, fit, perform
from nao_sim.motion.curves import curves_of
from nao_sim.motion.measures import Criteria, Measures, measure
from nao_sim.motion.violations import Violation, angle_violations, speed_violations
from nao_sim.robot import Nao

# A walking robot's centre of mass leaves the standing foot on purpose, and its joints follow corrections.
WALKING = Criteria(com_margin_mm=-np.inf, tracking_deg=5.0)


@dataclass(frozen=True, eq=False)
class Validation:
    """What became of one gesture.

    Attributes:
        name: as asked.
        faults: what is wrong, a line each; empty: it passes.
        changes: what fitting changed.
        measures, trajectory: None if it was refused before it could be played.
        limits: the range set that it was held to.
        violations: those of the faults that are angles out of range and speeds beyond the motors.
        notes: what reading the file took for granted or left out.
    """

    name: str
    faults: list[str]
    changes: list[Change]
    measures: Measures | None = None
    trajectory: Trajectory | None = None
    limits: str = "thesis"
    violations: list[Violation] = field(default_factory=list)
    notes: tuple[str, ...] = ()


def validate_gesture(
    name_or_file: str | Path,
    limits: str = "thesis",
    fitted: bool = False,
    criteria: Criteria | None = None,
    said: Said | None = None,
) -> Validation:
    """Check a gesture as it is written, play it free-standing, and measure.

    Args:
        name_or_file: a library gesture or a file.
        limits: ``"thesis"``, ``"v5"`` or ``"envelope"``.
        fitted: make it fit first and report the changes, instead of refusing it.
        criteria: bounds to pass; None for the library's own, or for a walk :data:`WALKING`.
        said: what a file does not say itself.

    Raises:
        NaoSimError: there is nothing to judge: no such gesture, a file that cannot be read, no such range set.
    """
    name = str(name_or_file)
    gesture, found = _judged(name_or_file, limits, said)
    if gesture.walk is not None:
        return _validate_walk(name, gesture, limits, criteria or WALKING)
    changes: list[Change] = []
    if not fitted and found:
        return Validation(name, [str(entry) for entry in found], [], None, None, limits, found, gesture.notes)
    trajectory = written(gesture)
    if fitted:
        trajectory, changes = fit(trajectory, limits)
    with Nao(limits=limits) as nao:
        log: MotionLog = perform(nao, trajectory)
        measures = measure(nao.model, trajectory, log, limits)
    faults = (criteria or Criteria()).faults(measures)
    return Validation(name, faults, changes, measures, trajectory, limits, [], gesture.notes)


def limits_kept(name_or_file: str | Path, limits: str = "thesis", said: Said | None = None) -> list[Violation]:
    """Return where a gesture or file leaves ranges or outruns motors, without playing it; arguments as above."""
    return _judged(name_or_file, limits, said)[1]


def _judged(name_or_file: str | Path, limits: str, said: Said | None) -> tuple[Gesture, list[Violation]]:
    """Return a gesture, or a file as a gesture, and its violations as it is written."""
    said = said or Said()
    path = Path(name_or_file)
    if str(name_or_file) not in library() and path.suffix.lower() != ".toml" and (path.suffix or path.exists()):
        return _judged_file(load_motion(path, said), limits, said)
    gesture = find_gesture(name_or_file, True, limits, said)
    if gesture.walk is not None:
        return gesture, []
    trajectory = written(gesture)
    # Key frames between two set-points count too; joints that nobody named are those of the whole-body kinematics.
    keys = gesture.curves()
    others = {name: curve for name, curve in curves_of(trajectory).items() if name not in keys}
    angles = angle_violations({**keys, **others}, limits)
    return gesture, angles + speed_violations(trajectory, limits)


def _judged_file(motion: MotionFile, limits: str, said: Said) -> tuple[Gesture, list[Violation]]:
    found = motion.violations(limits)
    out_of_range = any(not entry.unit.endswith("/s") for entry in found)
    return motion.gesture(said, limits, fit=out_of_range), found


def _validate_walk(name: str, gesture: Gesture, limits: str, criteria: Criteria) -> Validation:
    with Nao(limits=limits) as nao:
        done = act(nao, gesture)
        measures = measure(nao.model, done.trajectory, done.log, limits)
    return Validation(name, criteria.faults(measures), done.changes, measures, done.trajectory, limits)
