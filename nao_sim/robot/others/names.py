"""Which of a model's joints is which of NAO's: by NAOqi's names, with something before or after them, or in words.

``LShoulderPitch`` may be called ``nao/LShoulderPitch``, ``l_shoulder_pitch_joint``, ``left_arm.shoulder_pitch`` or
``LeftShoulderPitch``; whatever is called otherwise is told by a table.
"""

from __future__ import annotations

import csv
import re
from collections.abc import Iterable
from pathlib import Path

from nao_sim.errors import did_you_mean
from nao_sim.robot.errors import RobotError
from nao_sim.robot.joints import BODY

_SIDES = {"l": "left", "left": "left", "r": "right", "right": "right"}
_EMPTY = frozenset({"leg", "arm", "joint", "nao", "robot", "motor", "servo"})
_WORD = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+|\d+")


def _words(name: str) -> frozenset[str]:
    """Return the words of a name, the side written out, without those that only say what it is."""
    words = [word.lower() for part in re.split(r"[^A-Za-z0-9]+", name) for word in _WORD.findall(part)]
    return frozenset(_SIDES.get(word, word) for word in words) - _EMPTY


def matched(theirs: Iterable[str]) -> tuple[dict[str, str], str]:
    """Return NAOqi's name → the model's for every joint that is recognised, and how they were told, in words."""
    names = [name for name in theirs if name]
    exact = {name: name for name in BODY if name in names}
    if exact:
        rest, _ = _by_words(set(names) - set(exact))
        more = {joint: name for joint, name in rest.items() if joint not in exact}
        return exact | more, "by NAOqi's names" + (f", {len(more)} more by their words" if more else "")
    for name in names:
        inside = next((joint for joint in ("HeadYaw", "LShoulderPitch", "LHipPitch") if joint in name), None)
        if inside is not None:
            before, _, after = name.partition(inside)
            found = {joint: f"{before}{joint}{after}" for joint in BODY if f"{before}{joint}{after}" in names}
            around = " and ".join(f"'{part}' {where}" for part, where in ((before, "before"), (after, "after")) if part)
            return found, f"by NAOqi's names with {around} them"
    return _by_words(names)


def _by_words(names: Iterable[str]) -> tuple[dict[str, str], str]:
    by_words: dict[frozenset[str], list[str]] = {}
    for name in names:
        by_words.setdefault(_words(name), []).append(name)
    found = {joint: by_words[_words(joint)][0] for joint in BODY if len(by_words.get(_words(joint), [])) == 1}
    # One motor turns both, and some give its name to the left joint.
    shared = by_words.get(_words("HipYawPitch"), [])
    if "LHipYawPitch" not in found and len(shared) == 1:
        found["LHipYawPitch"] = shared[0]
    if not found:
        return {}, "no joint is called like one of NAO's"
    joint, name = next(iter(found.items()))
    return found, f"by their words: '{name}' is {joint}"


def read_names(path: Path) -> dict[str, str]:
    """Read a table of names: a line for each joint, NAOqi's name, a comma, and the model's.

    Raises:
        RobotError: not such a table, an unknown joint, or one told twice; the message has the line.
    """
    try:
        text = path.read_text("utf-8-sig")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8 text"
        raise RobotError(f"{path}: no table of names ({reason}); write lines like 'HeadYaw,head.yaw'") from None
    names: dict[str, str] = {}
    for number, row in enumerate(csv.reader(text.splitlines()), 1):
        cells = [cell.strip() for cell in row]
        if not any(cells) or cells[0].startswith("#"):
            continue
        if len(cells) != 2 or not all(cells):
            raise RobotError(f"{path}, line {number}: write NAOqi's name, a comma, and the model's")
        if cells[0] not in BODY:
            raise RobotError(f"{path}, line {number}: NAO has no joint '{cells[0]}'{did_you_mean(cells[0], BODY)}")
        if cells[0] in names:
            raise RobotError(f"{path}, line {number}: {cells[0]} for the second time")
        names[cells[0]] = cells[1]
    if not names:
        raise RobotError(f"{path}: no names; write lines like 'HeadYaw,head.yaw'")
    return names
