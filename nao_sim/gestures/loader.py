"""Gesture files in the project's own format: TOML, angles in degrees, hands from 0 closed to 1 open.

::

    name = "bye_right"              # meaning comes from the vocabulary when the name is in it
    easing = "cubic"                # or "minimum_jerk", the default
    follow_through_s = 0.04
    cycle = { first = "out", last = "out_again", repetitions = 3 }

    [[key_frame]]
    time = 0.7
    angles = { RShoulderPitch = -20, RElbowRoll = 60, RHand = 1 }
    torso = { pitch = 5.7, roll = 2, height = -0.01 }    # degrees, degrees, metres
    mark = "out"

    [[key_frame]]
    time = 2.5
    rest = true                     # every joint of the gesture back in StandInit

A walking gesture has ``[walk]`` with ``x``, ``y`` (metres) and ``turn`` (degrees) instead of key frames.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from nao_sim.errors import did_you_mean
from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import TORSO_KEYS, Cycle, KeyFrame, Walk
from nao_sim.gestures.vocabulary import CLASSES, FAMILIES, KINDS, vocabulary
from nao_sim.motion.easing import EASINGS
from nao_sim.motion.limits import HANDS

_MEANING = ("title", "number", "family", "kind", "class", "mirror")
_TOP = ("name", *_MEANING, "easing", "follow_through_s", "cycle", "amplitude_joints", "key_frame", "walk")
_FRAME = ("time", "angles", "torso", "rest", "mark")
# A file of more than this is not key frames written by a person.
_MAX_BYTES = 4_000_000


def load_toml_gesture(path: str | Path, fit: bool = False) -> Gesture:
    """Read one gesture file.

    Args:
        path: the TOML file.
        fit: leave angles outside their range for fitting to clip, instead of refusing them.

    Raises:
        GestureFileError: the file is missing, unreadable, malformed, or asks for what no NAO has.
    """
    path = Path(path)
    table = _parse(path)
    _only(table, _TOP, path, "the file")
    name = table.get("name", path.stem)
    if not isinstance(name, str) or not name:
        raise GestureFileError(path, f"name is {name!r}; write a word")
    if ("walk" in table) == ("key_frame" in table):
        raise GestureFileError(path, "a gesture has either [[key_frame]] tables or one [walk] table; write one of them")
    frames = tuple(_frame(row, index, path, fit) for index, row in enumerate(_frame_tables(table, path)))
    checks.increasing([frame.time_s for frame in frames], path)
    easing = table.get("easing", "minimum_jerk")
    if easing not in EASINGS:
        raise GestureFileError(path, f"easing is {easing!r}; write one of {', '.join(EASINGS)}")
    joints = table.get("amplitude_joints", [])
    if not isinstance(joints, list):
        raise GestureFileError(path, "amplitude_joints must be a list of joint names")
    return Gesture(
        name=name,
        **_meaning(name, table, path),
        key_frames=frames,
        easing=easing,
        follow_through_s=checks.number(table.get("follow_through_s", 0.0), path, "follow_through_s"),
        cycle=_cycle(table.get("cycle"), frames, path),
        amplitude_joints=tuple(checks.joint_name(str(joint), path, "amplitude_joints") for joint in joints),
        walk=_walk(table.get("walk"), path),
    )


def _parse(path: Path) -> dict[str, Any]:
    if not path.is_file():
        what = "is a folder, not a gesture file" if path.is_dir() else "no such gesture file"
        raise GestureFileError(path, what)
    if path.stat().st_size > _MAX_BYTES:
        raise GestureFileError(path, f"is larger than {_MAX_BYTES // 1_000_000} MB; a gesture is a list of key frames")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8"))
    except UnicodeDecodeError as error:
        raise GestureFileError(path, f"is not UTF-8 text (byte {error.start}); save it as UTF-8") from error
    except tomllib.TOMLDecodeError as error:
        raise GestureFileError(path, f"is not TOML: {error}") from error


def _only(table: Mapping[str, Any], known: Iterable[str], path: Path, where: str) -> None:
    for key in table:
        if key not in known:
            raise GestureFileError(path, f"{where} has an unknown key '{key}'{did_you_mean(key, known)}")


def _table(value: object, path: Path, where: str) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise GestureFileError(path, f"{where} is {value!r}; write a table like {{ key = 1 }}")
    return value


def _frame_tables(table: Mapping[str, Any], path: Path) -> list[dict[str, Any]]:
    if "walk" in table:
        return []
    rows = table["key_frame"]
    if not isinstance(rows, list) or not rows:
        raise GestureFileError(path, "has no key frames; write at least one [[key_frame]]")
    return [_table(row, path, f"key frame {index + 1}") for index, row in enumerate(rows)]


def _frame(row: dict[str, Any], index: int, path: Path, fit: bool) -> KeyFrame:
    where = f"key frame {index + 1}"
    _only(row, _FRAME, path, where)
    if "time" not in row:
        raise GestureFileError(path, f"{where} has no time; write seconds from the start")
    time_s = checks.number(row["time"], path, f"time of {where}")
    angles = {}
    for name, value in _table(row.get("angles", {}), path, f"angles of {where}").items():
        joint = checks.joint_name(name, path, where)
        asked = checks.number(value, path, f"{name} in {where}")
        angles[joint] = asked if joint in HANDS else float(np.deg2rad(asked))
    if not fit:
        checks.inside_range(angles, time_s, path)
    torso = _table(row.get("torso", {}), path, f"torso of {where}")
    _only(torso, TORSO_KEYS, path, f"torso of {where}")
    asked_torso = {key: checks.number(value, path, f"torso {key} in {where}") for key, value in torso.items()}
    rest = row.get("rest", False)
    if not isinstance(rest, bool) or (rest and (angles or torso)):
        raise GestureFileError(path, f"{where}: rest is true or false, and stands without angles and torso")
    if not (angles or torso or rest):
        raise GestureFileError(path, f"{where} moves nothing; write angles, torso or rest = true")
    mark = row.get("mark")
    if mark is not None and not isinstance(mark, str):
        raise GestureFileError(path, f"mark of {where} is {mark!r}; write a word")
    in_rad = {key: value if key == "height" else float(np.deg2rad(value)) for key, value in asked_torso.items()}
    return KeyFrame(time_s, angles, in_rad, rest, mark)


def _meaning(name: str, table: Mapping[str, Any], path: Path) -> dict[str, Any]:
    """Return what the gesture means: the vocabulary's word for a known name, else the file's."""
    entry = vocabulary().get(name)
    if entry is not None:
        said = [key for key in _MEANING if key in table]
        if said:
            raise GestureFileError(path, f"'{name}' is in the vocabulary, which gives its {said[0]}; leave it out here")
        return {
            "number": entry.number,
            "family": entry.family,
            "kind": entry.kind,
            "communicative_class": entry.communicative_class,
            "title": entry.title,
            "mirror": entry.mirror,
        }
    for key, allowed in (("family", FAMILIES), ("kind", KINDS), ("class", CLASSES)):
        if key in table and table[key] not in allowed:
            raise GestureFileError(path, f"{key} is {table[key]!r}; write one of {', '.join(allowed)}")
    return {
        "number": table.get("number"),
        "family": table.get("family", "own"),
        "kind": table.get("kind", "linear"),
        "communicative_class": table.get("class", "none"),
        "title": str(table.get("title", name)),
        "mirror": str(table.get("mirror", f"{name}_mirrored")),
    }


def _cycle(value: object, frames: tuple[KeyFrame, ...], path: Path) -> Cycle | None:
    if value is None:
        return None
    table = _table(value, path, "cycle")
    _only(table, ("first", "last", "repetitions"), path, "cycle")
    marks = [frame.mark for frame in frames]
    for key in ("first", "last"):
        if table.get(key) not in marks or table.get(key) is None:
            raise GestureFileError(path, f"cycle {key} is {table.get(key)!r}; no key frame has that mark")
    first, last = marks.index(table["first"]), marks.index(table["last"])
    if first >= last:
        raise GestureFileError(path, f"cycle ends at '{table['last']}', which does not come after '{table['first']}'")
    for joint in {name for frame in frames[first : last + 1] for name in frame.angles_rad}:
        if frames[first].angles_rad.get(joint) != frames[last].angles_rad.get(joint):
            raise GestureFileError(path, f"cycle: {joint} must be the same at '{table['first']}' and '{table['last']}'")
    repetitions = table.get("repetitions", 1)
    if not isinstance(repetitions, int) or repetitions < 1:
        raise GestureFileError(path, f"cycle repetitions is {repetitions!r}; write 1 or more")
    return Cycle(table["first"], table["last"], repetitions)


def _walk(value: object, path: Path) -> Walk | None:
    if value is None:
        return None
    table = _table(value, path, "walk")
    _only(table, ("x", "y", "turn"), path, "walk")
    numbers = {key: checks.number(item, path, f"walk {key}") for key, item in table.items()}
    if not any(numbers.values()):
        raise GestureFileError(path, "walk goes nowhere; write x, y (metres) or turn (degrees)")
    return Walk(numbers.get("x", 0.0), numbers.get("y", 0.0), float(np.deg2rad(numbers.get("turn", 0.0))))
