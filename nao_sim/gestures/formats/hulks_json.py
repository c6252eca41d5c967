"""HULKs' motion JSON: a pose to start from, then key frames with the seconds that each takes; radians.

The newer form has phases (``motion``) with conditions to go on or to stop, the older one a list of ``frames``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile, of_rows
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text, write_whole
from nao_sim.gestures.formats.whole_poses import whole_poses
from nao_sim.motion.curves import Curve
from nao_sim.motion.trajectory import CONTROL_PERIOD
from nao_sim.robot.joints import BODY

_PARTS = {"head": "Head", "left_arm": "L", "right_arm": "R", "left_leg": "L", "right_leg": "R"}
_CONDITIONS = ("entry_condition", "exit_condition", "interrupt_conditions")


def read(path: Path, said: Said) -> MotionFile:
    """Read a motion.

    Raises:
        GestureFileError: not such a file, with the place of what is wrong.
    """
    content = parse(read_text(path), path)
    if not is_motion(content):
        raise GestureFileError(path, "has no 'initial_positions' with 'motion' or 'frames'; is it a HULKs motion?")
    poses = [_pose(content["initial_positions"], "initial_positions", path)]
    times, now = [0.0], 0.0
    notes: dict[str, None] = {}
    for where, frame in _frames(content, path, notes):
        if not isinstance(frame, dict) or "duration" not in frame or "positions" not in frame:
            raise GestureFileError(path, f"{where} has no 'duration' and 'positions'")
        took = _seconds(frame["duration"], path, where)
        if took == 0:
            notes["key frames that take 0 s are steps of one control period, 20 ms"] = None
        now += took or CONTROL_PERIOD
        checks.not_too_long(now, path, said.longest_s)
        times.append(now)
        poses.append(_pose(frame["positions"], f"{where}.positions", path))
    names = list(dict.fromkeys(name for pose in poses for name in pose))
    rows = np.array([[pose.get(name, np.nan) for name in names] for pose in poses])
    return of_rows(path, names, np.array(times), rows, list(notes))


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion of one phase; joints that it does not name stay as in StandInit."""
    times, rows, notes = whole_poses(curves, BODY)
    poses = [_positions(dict(zip(BODY, row, strict=True))) for row in np.round(rows, 6).tolist()]
    frames = [
        {"duration": round(float(step), 6), "positions": pose}
        for step, pose in zip(np.diff(times), poses[1:], strict=True)
    ]
    content = {"initial_positions": poses[0], "motion": [{"keyframes": frames}]}
    write_whole(path, json.dumps(content, indent=2) + "\n")
    return notes + (["the time before the first pose is left to the robot"] if times[0] > 0 else [])


def parse(text: str, path: Path) -> Any:
    """Return a JSON document; refuse what is none with line and column."""
    try:
        return json.loads(text)
    except json.JSONDecodeError as error:
        raise GestureFileError(path, f"line {error.lineno}, column {error.colno}: is not JSON ({error.msg})") from None
    except RecursionError:
        raise GestureFileError(path, "is nested too deeply to be a motion") from None


def is_motion(content: Any) -> bool:
    """Return whether a document has the form of a motion."""
    return isinstance(content, dict) and "initial_positions" in content and ("motion" in content or "frames" in content)


def _frames(content: dict[str, Any], path: Path, notes: dict[str, None]) -> Iterator[tuple[str, Any]]:
    phases = [{"keyframes": content["frames"]}] if "frames" in content else content["motion"]
    if not isinstance(phases, list):
        raise GestureFileError(path, "motion is no list of phases")
    for number, phase in enumerate(phases):
        if not isinstance(phase, dict) or not isinstance(phase.get("keyframes"), list):
            raise GestureFileError(path, f"motion[{number}] has no list 'keyframes'")
        for condition in _CONDITIONS:
            if phase.get(condition):
                notes["conditions to go on or to stop are not carried over"] = None
        for index, frame in enumerate(phase["keyframes"]):
            yield f"motion[{number}].keyframes[{index}]", frame


def _seconds(value: Any, path: Path, where: str) -> float:
    if isinstance(value, dict) and {"secs", "nanos"} <= set(value):
        parts = (checks.number(value[key], path, f"{where}.duration.{key}") for key in ("secs", "nanos"))
        value = next(parts) + 1e-9 * next(parts)
    seconds = checks.number(value, path, f"{where}.duration")
    if seconds < 0:
        raise GestureFileError(path, f"{where}.duration is {seconds:g}; write 0 or more seconds")
    return seconds


def _pose(value: Any, where: str, path: Path) -> dict[str, float]:
    if not isinstance(value, dict):
        raise GestureFileError(path, f"{where} is no object of body parts")
    pose: dict[str, float] = {}
    for part, joints in value.items():
        if part not in _PARTS or not isinstance(joints, dict):
            raise GestureFileError(path, f"{where}.{part} is no body part; known: {', '.join(_PARTS)}")
        for joint, angle in joints.items():
            if angle is None:
                continue
            camel = "".join(word.capitalize() for word in joint.split("_"))
            name = checks.joint_name(_PARTS[part] + camel, path, f"{where}.{part}.{joint}")
            if name not in pose or _PARTS[part] == "L":
                pose[name] = checks.number(angle, path, f"{where}.{part}.{joint}")
    return pose


def _positions(pose: Mapping[str, float]) -> dict[str, dict[str, float]]:
    parts: dict[str, dict[str, float]] = {part: {} for part in _PARTS}
    for name, angle in pose.items():
        leg = any(word in name for word in ("Hip", "Knee", "Ankle"))
        side = {"L": "left", "R": "right"}.get(name[0], "")
        part = f"{side}_{'leg' if leg else 'arm'}" if side else "head"
        words = re.findall(r"[A-Z][a-z]*", name.removeprefix("Head") if part == "head" else name[1:])
        parts[part]["_".join(words).lower()] = angle
    return parts
