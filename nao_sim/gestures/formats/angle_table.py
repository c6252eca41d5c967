"""Tables of joint angles as CSV: a time column and a column a joint.

The first line names the columns: ``time`` or ``time_s`` (seconds), and NAOqi joints, in degrees (``HeadYaw`` or
``HeadYaw_deg``) or radians (``HeadYaw_rad``); hands are fractions open. An empty cell leaves the joint alone.
"""

from __future__ import annotations

import csv
import io
from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.dense import gesture_of_samples, read_lines, write_whole
from nao_sim.gestures.gesture import Gesture
from nao_sim.motion.limits import HANDS
from nao_sim.motion.trajectory import Trajectory

_TIME = ("time", "time_s", "t")


def read_csv(path: str | Path, fit: bool = False) -> Gesture:
    """Read a table of joint angles as a gesture named after the file.

    Raises:
        GestureFileError: not such a table, an unknown joint, times out of order, an angle outside its range.
    """
    path = Path(path)
    table = [row for row in csv.reader(read_lines(path)) if any(cell.strip() for cell in row)]
    if not table or table[0][0].strip().lower() not in _TIME:
        raise GestureFileError(path, "has no header line; write 'time,HeadYaw,...' first")
    columns = [_column(cell.strip(), path) for cell in table[0][1:]]
    names = [name for name, _ in columns]
    if len(set(names)) != len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise GestureFileError(path, f"has two columns for {twice}; keep one")
    times, rows = [], []
    for number, row in enumerate(table[1:], start=2):
        if len(row) != len(columns) + 1:
            raise GestureFileError(path, f"line {number} has {len(row)} cells, the header has {len(columns) + 1}")
        times.append(_number(row[0], path, number))
        angles = [_number(cell, path, number) if cell.strip() else np.nan for cell in row[1:]]
        rows.append([value * scale for value, (_, scale) in zip(angles, columns, strict=True)])
    return gesture_of_samples(path, names, times, np.array(rows), fit)


def write_csv(trajectory: Trajectory, path: str | Path) -> None:
    """Write a trajectory as a table, degrees, a row a sample."""
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["time_s", *(name if name in HANDS else f"{name}_deg" for name in trajectory.names)])
    scale = np.array([1.0 if name in HANDS else np.rad2deg(1.0) for name in trajectory.names])
    for time, row in zip(trajectory.times, trajectory.targets * scale, strict=True):
        writer.writerow([f"{time:.3f}", *(f"{value:.5f}" for value in row)])
    write_whole(Path(path), out.getvalue())


def _column(cell: str, path: Path) -> tuple[str, float]:
    """Return the joint of a column and the factor that brings its numbers to rad or fraction."""
    bare = cell.removesuffix("_deg").removesuffix("_rad")
    name = checks.joint_name(bare, path, "header")
    return name, 1.0 if name in HANDS or cell.endswith("_rad") else float(np.deg2rad(1.0))


def _number(cell: str, path: Path, line: int) -> float:
    try:
        return checks.number(float(cell), path, f"line {line}")
    except ValueError:
        raise GestureFileError(path, f"line {line}: '{cell}' is not a number") from None
