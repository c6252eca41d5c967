"""What every motion file is once it is read: keys of some joints against time, and what was left out on the way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import KeyFrame
from nao_sim.motion.curves import Curve
from nao_sim.motion.limits import unit_of
from nao_sim.motion.violations import Violation, angle_violations, violations
from nao_sim.robot.joints import joint_table
from nao_sim.robot.tolerance import on_limits


@dataclass(frozen=True, eq=False)
class MotionFile:
    """The content of a motion file.

    Attributes:
        path: where it came from; its stem is the motion's name.
        curves: NAOqi joint name → its keys; seconds from the start and rad (hands: fraction open).
        notes: for people: what was taken for granted and what was not carried over.
    """

    path: Path
    curves: Mapping[str, Curve]
    notes: tuple[str, ...] = ()

    @property
    def duration_s(self) -> float:
        """Seconds from the start to the last key."""
        return max(float(curve.times[-1]) for curve in self.curves.values())

    def violations(self, limits: str = "thesis") -> list[Violation]:
        """Return where it leaves ranges or outruns motors; see :func:`nao_sim.motion.violations.violations`."""
        return violations(self.curves, limits)

    def gesture(self, said: Said, limits: str = "thesis", fit: bool = False) -> Gesture:
        """Return it as a gesture that is named after the file.

        Args:
            said: for how long it may last.
            limits: the range set that it must keep.
            fit: leave angles outside their range for fitting to clip, instead of refusing them.

        Raises:
            GestureFileError: an angle outside its range.
        """
        if not fit:
            _refuse(self.path, angle_violations(self.curves, limits))
        straight, notes = _on_limits({name: curve.straight() for name, curve in self.curves.items()}, limits, fit)
        frames: dict[float, dict[str, float]] = {}
        for name, curve in straight.items():
            for time_s, value in zip(curve.times.tolist(), curve.values.tolist(), strict=True):
                frames.setdefault(time_s, {})[name] = value
        name = self.path.stem
        return Gesture(
            name=name,
            number=None,
            family="own",
            kind="linear",
            communicative_class="none",
            title=name,
            mirror=f"{name}_mirrored",
            key_frames=tuple(KeyFrame(time_s, frames[time_s]) for time_s in sorted(frames)),
            easing="linear",
            longest_s=said.longest_s,
            notes=self.notes + notes,
        )


def of_rows(
    path: Path,
    names: Sequence[str],
    times: NDArray[np.float64],
    rows: NDArray[np.float64],
    notes: Sequence[str] = (),
    lines: Sequence[int] | None = None,
) -> MotionFile:
    """Return samples of several joints as a motion.

    Args:
        path: where they came from.
        names: NAOqi joint names, already checked, length k.
        times: seconds from the start, shape (n,).
        rows: rad (hands: fraction), shape (n, k); NaN: the joint has no key then.
        notes: see :class:`MotionFile`.
        lines: where the rows stand in the file, for messages.

    Raises:
        GestureFileError: no samples, no angles, or times out of order.
    """
    if not len(times):
        raise GestureFileError(path, "has no samples; write a line for each pose")
    checks.increasing(times.tolist(), path, lines)
    curves = {}
    for column, name in enumerate(names):
        known = np.isfinite(rows[:, column])
        if known.any():
            curves[name] = Curve(times[known], rows[known, column])
    if not curves:
        raise GestureFileError(path, "moves no joint; write at least one angle")
    return MotionFile(path, curves, tuple(notes))


def _refuse(path: Path, out: list[Violation]) -> None:
    if not out:
        return
    worst = max(out, key=lambda entry: max(entry.value - entry.bounds[1], entry.bounds[0] - entry.value))
    more = "" if len(out) == 1 else f" (and {len(out) - 1} more: nao-sim validate lists them)"
    mends = [f"--limits {worst.allowed_by[0]}"] if worst.allowed_by else []
    hint = "; are these degrees?" if worst.unit == "deg" and abs(worst.value) > 400 else ""
    raise GestureFileError(path, f"{worst}{more}{hint}; keep inside it, or pass {' or '.join([*mends, '--fit'])}")


def _on_limits(curves: Mapping[str, Curve], limits: str, fit: bool) -> tuple[dict[str, Curve], tuple[str, ...]]:
    """Return curves with what is past a limit by the joints' own softness put on it, and a note of the furthest."""
    put, furthest = {}, (0.0, "")
    for name, curve in curves.items():
        low, high = joint_table().select([name]).range_rad(limits)[0]
        inside = on_limits(curve.values, low, high)
        moved = np.abs(inside - curve.values)
        furthest = max(furthest, (float(moved.max()) * unit_of(name)[1], name))
        put[name] = Curve(curve.times, inside)
    past, name = furthest
    # Rounding is not worth a word.
    note = f"{name} is up to {past:.2g} {unit_of(name)[0]} past its '{limits}' range, as measured joints are; put on it"
    return put, (note,) if past > 0.01 and not fit else ()
