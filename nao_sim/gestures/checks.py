"""Checks that every gesture file goes through, whatever its format, with the place and the mend in each message."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from nao_sim.errors import did_you_mean
from nao_sim.gestures.errors import GestureFileError
from nao_sim.motion.limits import HANDS
from nao_sim.robot.joints import BODY, joint_table
from nao_sim.robot.tolerance import on_limits, tell_apart


def number(value: object, path: Path, where: str) -> float:
    """Return a finite number, or refuse what stands in its place."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        raise GestureFileError(path, f"{where} is {value!r}; write a finite number")
    return float(value)


def joint_name(name: str, path: Path, where: str) -> str:
    """Return a NAOqi joint name, or refuse it with the nearest one; RHipYawPitch is the left one's motor."""
    if name not in BODY:
        raise GestureFileError(path, f"{where}: unknown joint '{name}'{did_you_mean(name, BODY)}")
    return "LHipYawPitch" if name == "RHipYawPitch" else name


def increasing(times: Sequence[float], path: Path) -> None:
    """Refuse times that are negative or do not increase."""
    for index, time in enumerate(times):
        if time < 0:
            raise GestureFileError(path, f"key frame {index + 1} is at {time:g} s; times start at 0")
        if index and time <= times[index - 1]:
            raise GestureFileError(
                path, f"key frame {index + 1} is at {time:g} s, not after {times[index - 1]:g} s; put them in order"
            )


def inside_range(
    angles_rad: Mapping[str, float], time_s: float, path: Path, limits: str = "thesis"
) -> dict[str, float]:
    """Return angles inside their ranges, those past them by no more than the joints' softness put on the limit.

    Raises:
        GestureFileError: an angle is further out; the message names the joint, the time and the bound.
    """
    table = joint_table()
    ranges = table.range_rad(limits)
    inside = {}
    for name, value in angles_rad.items():
        low, high = ranges[table.index(name)]
        inside[name] = float(on_limits(value, low, high))
        if low <= inside[name] <= high:
            continue
        scale = 1.0 if name in HANDS else np.rad2deg(1.0)
        shown = tell_apart(value * scale, low * scale, high * scale)
        unit = "(0 closed, 1 open)" if name in HANDS else "deg"
        raise GestureFileError(
            path,
            f"{name} at {time_s:g} s is {shown[0]}, outside its range {shown[1]} .. {shown[2]} {unit}; "
            "keep inside it or pass --fit",
        )
    return inside
