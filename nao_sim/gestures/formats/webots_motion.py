"""Webots ``.motion`` files: a header of motor names, then a pose a line.

::

    #WEBOTS_MOTION,V1.0,HeadYaw,LShoulderPitch
    00:00:000,Pose1,0.1,1.4
    00:00:020,Pose2,*,1.3

Angles are radians; ``*`` leaves a motor alone; a time is ``m:s:ms``, ``s:ms`` or ``ms``. Webots's NAO has no hand
motor but eight finger joints a hand, all of which carry the hand's opening; and a motor for each HipYawPitch, which
on the robot are one (the left one's is read). Teams of the RoboCup 3D simulation league write V1.0 and V1.1 with the
names on a line of their own, V1.1 parted by ``%``, each line with the seconds that it takes at its end
(``play%0.1%1.4%0.5``); these are read.
"""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile, of_rows
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text, write_whole
from nao_sim.motion.curves import Curve, rows_of, union_of_times
from nao_sim.motion.trajectory import CONTROL_PERIOD

_MAGIC = "#WEBOTS_MOTION"
_VERSIONS = ("V1.0", "V1.1")
_TIME = re.compile(r"(?:(?:(\d+):)?(\d+):)?(\d+)")
_FINGERS = 8


def read(path: Path, said: Said) -> MotionFile:
    """Read a Webots motion.

    Raises:
        GestureFileError: not such a file, with line and column of what is wrong.
    """
    lines = read_text(path).splitlines()
    first = [cell.strip() for cell in lines[0].split(",")] if lines else [""]
    if first[0] != _MAGIC:
        raise GestureFileError(path, f"does not start with '{_MAGIC},V1.0'; is it a Webots motion?")
    if len(first) < 2 or first[1] not in _VERSIONS:
        version = first[1] if len(first) > 1 else ""
        raise GestureFileError(path, f"line 1: version '{version}' is not known; known: {', '.join(_VERSIONS)}")
    body = [(number, line) for number, line in enumerate(lines[1:], start=2) if line.strip(" ,\t%")]
    notes = [_blank(lines)]
    if not any(first[2:]) and body:
        names_line, body = body[0], body[1:]
        sign = "%" if "%" in names_line[1] else ","
        first = ["", "", *(cell.strip() for cell in names_line[1].split(sign))]
    else:
        sign = ","
    body = [(number, line) for number, line in body if not line.startswith("#")]
    asked = _without_end(first[2:])
    columns = _columns(asked, path)
    played = bool(body) and _is_played(body[0][1], sign)
    now, times = 0.0, []
    rows: list[list[float]] = []
    for number, line in body:
        cells = _without_end([cell.strip() for cell in line.split(sign)])
        if played:
            if len(cells) != len(asked) + 2:
                _wrong_count(path, number, len(cells) - 2, len(asked))
            took = _angle(cells[-1], path, number, len(cells), "seconds")
            # What takes no time is a step, which no set-point can make faster than the next one comes.
            now += took or (CONTROL_PERIOD if rows else 0.0)
            cells = ["", *cells[:-1]]
        elif len(cells) != len(asked) + 2:
            _wrong_count(path, number, len(cells) - 2, len(asked))
        times.append(now if played else _seconds(cells[0], path, number))
        rows.append([_angle(cells[at + 2], path, number, at + 3, "an angle in radians") for at in columns.values()])
    if times:
        checks.not_too_long(times[-1], path, said.longest_s, times[0])
    numbers = [number for number, _ in body]
    return of_rows(path, list(columns), np.array(times), np.array(rows), [note for note in notes if note], numbers)


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion for Webots, a pose a key; ``*`` before a joint's first key and after its last."""
    names, picked = [], []
    for index, name in enumerate(curves):
        fingers = [f"{name[0]}Phalanx{finger}" for finger in range(1, _FINGERS + 1)]
        names += fingers if name.endswith("Hand") else [name]
        picked += [index] * (_FINGERS if name.endswith("Hand") else 1)
    if "LHipYawPitch" in curves:
        names.append("RHipYawPitch")
        picked.append(list(curves).index("LHipYawPitch"))
    times = union_of_times({name: curve.straight() for name, curve in curves.items()})
    whole, kept = np.unique(np.round(times * 1000).astype(int), return_index=True)
    lines = [",".join([_MAGIC, _VERSIONS[0], *names])]
    for pose, (stamp, row) in enumerate(zip(whole.tolist(), rows_of(curves, times[kept])[:, picked], strict=True)):
        clock = f"{stamp // 60000:02d}:{stamp // 1000 % 60:02d}:{stamp % 1000:03d}"
        cells = ("*" if math.isnan(value) else f"{value:.6g}" for value in row.tolist())
        lines.append(",".join([clock, f"Pose{pose + 1}", *cells]))
    write_whole(path, "\n".join(lines) + "\n")
    return ["times are whole milliseconds there"] if np.abs(times * 1000 - np.round(times * 1000)).max() > 1e-3 else []


def _columns(asked: list[str], path: Path) -> dict[str, int]:
    """Return joint → column; of several that are one motor on the robot, the first, or the left HipYawPitch."""
    columns: dict[str, int] = {}
    for index, name in enumerate(asked):
        finger = re.fullmatch(r"([LR])Phalanx[1-8]", name)
        where = f"line 1, column {index + 3}"
        joint = f"{finger[1]}Hand" if finger else checks.joint_name(name, path, where)
        if joint in columns and not finger and "HipYawPitch" not in name:
            raise GestureFileError(path, f"{where}: a second column for {joint}; keep one")
        if name == "LHipYawPitch":
            columns[joint] = index
        columns.setdefault(joint, index)
    return columns


def _without_end(cells: list[str]) -> list[str]:
    """Return cells without the empty ones at the end, which trailing commas leave."""
    while cells and not cells[-1]:
        cells = cells[:-1]
    return cells


def _blank(lines: list[str]) -> str:
    """Return a note if a blank line stands before a pose: Webots itself stops reading there."""
    last = max((index for index, line in enumerate(lines) if line.strip()), default=0)
    blank = next((index + 1 for index, line in enumerate(lines[:last]) if not line.strip()), None)
    return f"line {blank} is empty; Webots ends the motion there, we read on" if blank else ""


def _is_played(line: str, sign: str) -> bool:
    return line.split(sign)[0].strip() == "play"


def _wrong_count(path: Path, line: int, have: int, want: int) -> None:
    raise GestureFileError(path, f"line {line} has {max(have, 0)} angles, the header names {want}")


def _seconds(cell: str, path: Path, line: int) -> float:
    stamp = _TIME.fullmatch(cell)
    if stamp is None:
        raise GestureFileError(
            path, f"line {line}, column 1: '{cell}' is not a time; write minutes:seconds:milliseconds"
        )
    minutes, seconds, thousandths = (int(part or 0) for part in stamp.groups())
    return 60 * minutes + seconds + thousandths / 1000


def _angle(cell: str, path: Path, line: int, column: int, what: str) -> float:
    if cell == "*" and what != "seconds":
        return math.nan
    try:
        return checks.number(float(cell), path, f"line {line}, column {column}")
    except ValueError:
        raise GestureFileError(path, f"line {line}, column {column}: '{cell}' is not {what}") from None
