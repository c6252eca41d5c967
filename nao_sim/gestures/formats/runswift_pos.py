"""rUNSWift's ``.pos`` files: a pose a line, 25 joints in degrees and the milliseconds that it takes to get there.

``#`` begins a comment; a line with ``$`` gives the stiffness of each joint, which nothing here has.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile, of_rows
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text, write_whole
from nao_sim.gestures.formats.whole_poses import whole_poses
from nao_sim.motion.curves import Curve
from nao_sim.motion.limits import unit_of
from nao_sim.motion.trajectory import CONTROL_PERIOD

_LEG = ("HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll")
_ARM = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand")
JOINTS = (
    "HeadYaw",
    "HeadPitch",
    *(f"L{joint}" for joint in _ARM),
    "LHipYawPitch",
    *(f"L{joint}" for joint in _LEG),
    *(f"R{joint}" for joint in _LEG),
    *(f"R{joint}" for joint in _ARM),
)
_HEADER = "# HY HP LSP LSR LEY LER LWY LH LHYP LHR LHP LKP LAP LAR RHR RHP RKP RAP RAR RSP RSR REY RER RWY RH DUR"


def read(path: Path, said: Said) -> MotionFile:
    """Read a motion.

    Raises:
        GestureFileError: not such a file, with the line of what is wrong.
    """
    now, times, lines = 0.0, [], []
    rows: list[list[float]] = []
    notes: dict[str, None] = {}
    for number, line in enumerate(read_text(path).splitlines(), start=1):
        cells = line.split("#")[0].split()
        if not cells:
            continue
        if cells[0].startswith("$"):
            notes["stiffness ($) is not carried over"] = None
            continue
        if len(cells) != len(JOINTS) + 1:
            raise GestureFileError(path, f"line {number} has {len(cells)} numbers; a pose has 25 joints and a duration")
        pose = [_number(cell, path, number, column) for column, cell in enumerate(cells, start=1)]
        if pose[-1] < 0:
            raise GestureFileError(path, f"line {number}: takes {pose[-1]:g} ms; write 0 or more")
        if pose[-1] == 0 and rows:
            notes["poses that take 0 ms are steps of one control period, 20 ms"] = None
        now += pose[-1] / 1000 or (CONTROL_PERIOD if rows else 0.0)
        checks.not_too_long(now, path, said.longest_s)
        times.append(now)
        rows.append(pose[:-1])
        lines.append(number)
    scale = np.array([unit_of(name)[1] for name in JOINTS])
    angles = np.array(rows).reshape(len(rows), len(JOINTS)) / scale
    return of_rows(path, JOINTS, np.array(times), angles, list(notes), lines)


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion; joints that it does not name stay as in StandInit."""
    times, rows, notes = whole_poses(curves, JOINTS)
    scale = np.array([unit_of(name)[1] for name in JOINTS])
    before, lines = 0, [_HEADER]
    for time, row in zip(times.tolist(), (rows * scale).tolist(), strict=True):
        now = round(time * 1000)
        if now <= before and len(lines) > 1:
            continue
        lines.append(" ".join([*(f"{value:.6f}".rstrip("0").rstrip(".") for value in row), str(max(now - before, 0))]))
        before = now
    write_whole(path, "\n".join(lines) + "\n")
    return notes


def _number(cell: str, path: Path, line: int, column: int) -> float:
    try:
        return checks.number(float(cell), path, f"line {line}, column {column}")
    except ValueError:
        raise GestureFileError(path, f"line {line}, column {column}: '{cell}' is not a number") from None
