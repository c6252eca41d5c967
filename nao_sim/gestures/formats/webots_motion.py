"""Webots ``.motion`` files: a header of motor names, then a pose a line.

::

    #WEBOTS_MOTION,V1.0,HeadYaw,LShoulderPitch
    00:00:000,Pose1,0.1,1.4
    00:00:020,Pose2,*,1.3

Angles are radians; ``*`` leaves a motor alone. Webots's NAO has no hand motor but eight finger joints a hand, all of
which carry the hand's opening; and a motor for each HipYawPitch, which on the robot are one (the left one's is read).
"""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.dense import gesture_of_samples, read_lines, write_whole
from nao_sim.gestures.gesture import Gesture
from nao_sim.motion.trajectory import Trajectory

_HEADER = "#WEBOTS_MOTION,V1.0"
_TIME = re.compile(r"(\d+):(\d\d):(\d\d\d)")
_FINGERS = 8


def read_webots_motion(path: str | Path, fit: bool = False) -> Gesture:
    """Read a Webots motion as a gesture named after the file.

    Raises:
        GestureFileError: not such a file, an unknown joint, times out of order, an angle outside its range.
    """
    path = Path(path)
    lines = read_lines(path)
    if not lines or not lines[0].startswith(_HEADER):
        raise GestureFileError(path, f"does not start with '{_HEADER}'; is it a Webots motion?")
    asked = [name.strip() for name in lines[0].split(",")[2:] if name.strip()]
    names = [_joint(name, path) for name in asked]
    columns = {name: index for index, name in reversed(list(enumerate(names)))}
    times, rows = [], []
    for number, line in enumerate(lines[1:], start=2):
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split(",")]
        if len(cells) != len(asked) + 2:
            raise GestureFileError(path, f"line {number} has {len(cells) - 2} angles, the header names {len(asked)}")
        stamp = _TIME.fullmatch(cells[0])
        if stamp is None:
            raise GestureFileError(
                path, f"line {number}: '{cells[0]}' is not a time; write minutes:seconds:milliseconds"
            )
        minutes, seconds, thousandths = map(int, stamp.groups())
        times.append(60 * minutes + seconds + thousandths / 1000)
        rows.append([_angle(cells[index + 2], path, number) for index in columns.values()])
    return gesture_of_samples(path, list(columns), times, np.array(rows), fit)


def write_webots_motion(trajectory: Trajectory, path: str | Path) -> None:
    """Write a trajectory as a Webots motion, a pose each control period."""
    names, picked = [], []
    for index, name in enumerate(trajectory.names):
        if name.endswith("Hand"):
            names += [f"{name[0]}Phalanx{finger}" for finger in range(1, _FINGERS + 1)]
            picked += [index] * _FINGERS
        else:
            names.append(name)
            picked.append(index)
    names.append("RHipYawPitch")
    picked.append(trajectory.names.index("LHipYawPitch"))
    lines = [",".join([_HEADER, *names])]
    for pose, (time, row) in enumerate(zip(trajectory.times - trajectory.times[0], trajectory.targets, strict=True)):
        whole = round(float(time) * 1000)
        stamp = f"{whole // 60000:02d}:{whole // 1000 % 60:02d}:{whole % 1000:03d}"
        lines.append(",".join([stamp, f"Pose{pose + 1}", *(f"{value:.6g}" for value in row[picked])]))
    write_whole(Path(path), "\n".join(lines) + "\n")


def _joint(name: str, path: Path) -> str:
    finger = re.fullmatch(r"([LR])Phalanx[1-8]", name)
    return f"{finger[1]}Hand" if finger else checks.joint_name(name, path, "header")


def _angle(cell: str, path: Path, line: int) -> float:
    if cell == "*":
        return float("nan")
    try:
        return checks.number(float(cell), path, f"line {line}")
    except ValueError:
        raise GestureFileError(path, f"line {line}: '{cell}' is not an angle in radians") from None
