"""Motions in Python scripts: what Choregraphe exports, what ``nao-sim export`` writes, and what people write by hand.

A script is parsed and never run. Of it are understood: lists called ``names``, ``times``, ``keys`` (or
``angleLists``, ``timeLists``), filled by assignment, ``append`` or ``extend``, and the arguments of
``angleInterpolation`` and ``angleInterpolationBezier``; numbers may be computed with ``+ - * /``, ``math.pi``,
``math.radians`` and ``TO_RAD``. A key is an angle in radians, or an angle with its two Bezier handles ``[angle, [3,
-dt, da], [3, dt, da]]``. Scripts for Python 2, as NAOqi's are, are read line by line.
"""

from __future__ import annotations

import ast
import math
import textwrap
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from nao_sim.errors import did_you_mean
from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text
from nao_sim.motion.curves import Curve

_MAX_BYTES = 8_000_000
_ROLES = {"names": "names", "times": "times", "timelists": "times", "timelist": "times"}
_ROLES |= {"keys": "keys", "anglelists": "keys", "anglelist": "keys"}
_ORDER = {"angleInterpolation": ("names", "keys", "times"), "angleInterpolationBezier": ("names", "times", "keys")}
# Methods of the robot that people call beside: whoever reads the motion alone should know that they were there.
_LEFT_OUT = frozenset(
    {"goToPosture", "setStiffnesses", "stiffnessInterpolation", "wakeUp", "rest", "say", "setAngles", "changeAngles"}
    | {"moveTo", "walkTo", "move", "moveToward", "setWalkTargetVelocity", "moveInit", "openHand", "closeHand"}
)


class _NotConstant(Exception):
    """An expression that only running the script would tell."""


@dataclass
class _Found:
    """One motion of a script."""

    place: str
    lists: dict[str, list[Any]] = field(default_factory=dict)

    @property
    def whole(self) -> bool:
        return all(self.lists.get(role) for role in ("names", "times", "keys"))


def read(path: Path, said: Said) -> MotionFile:
    """Read the motion of a Python script.

    Raises:
        GestureFileError: no motion in it, several of them and none chosen, or one that is not whole.
    """
    found, left_out = _search(read_text(path, _MAX_BYTES), path)
    motions = [motion for motion in found if motion.whole]
    if not motions:
        raise GestureFileError(
            path, "has no lists names, times and keys with constant values; export it from Choregraphe"
        )
    notes = [f"of the script only the joint angles are read; left out: {', '.join(left_out)}"] if left_out else []
    chosen = _chosen(motions, path, said)
    curves = _curves(chosen, path)
    checks.not_too_long(max(float(curve.times[-1]) for curve in curves.values()), path, said.longest_s)
    return MotionFile(path, curves, tuple(notes))


def is_motion(text: str) -> bool:
    """Return whether a script looks as if it held a motion."""
    low = text.lower()
    exported = "names" in low and "times" in low and "keys" in low and "yaw" in low + "pitch"
    return exported or "angleinterpolation" in low


def _chosen(motions: list[_Found], path: Path, said: Said) -> _Found:
    if said.part is None:
        if len(motions) == 1:
            return motions[0]
        names = ", ".join(f"{number} ({motion.place})" for number, motion in enumerate(motions, start=1))
        raise GestureFileError(path, f"holds {len(motions)} motions; choose one with --part: {names}")
    for number, motion in enumerate(motions, start=1):
        if said.part in (str(number), motion.place):
            return motion
    known = [motion.place for motion in motions]
    raise GestureFileError(path, f"has no part '{said.part}'{did_you_mean(said.part, known)}")


def _search(text: str, path: Path) -> tuple[list[_Found], list[str]]:
    """Return the motions of a script in their order, and the robot's other methods that it calls."""
    known: dict[str, Any] = {}
    found: list[_Found] = [_Found("the script")]
    left_out: dict[str, None] = {}
    for place, statement in _statements(text, path):
        for node in ast.walk(statement):
            if isinstance(node, ast.Attribute) and node.attr in _LEFT_OUT:
                left_out[node.attr] = None
        _take(statement, place, known, found)
    return found, list(left_out)


def _statements(text: str, path: Path) -> Iterator[tuple[str, ast.stmt]]:
    """Yield each simple statement with the function that it stands in; scripts for Python 2 line by line."""
    try:
        yield from _simple(ast.parse(text).body, "the script")
        return
    except (SyntaxError, ValueError):
        pass
    except (RecursionError, MemoryError):
        raise GestureFileError(path, "is nested too deeply to be a motion") from None
    place = "the script"
    for line in _logical_lines(text):
        bare = line.strip()
        if bare.startswith(("def ", "class ")):
            place = bare.split("(")[0].split(":")[0].split(None, 1)[1]
            continue
        try:
            for statement in ast.parse(textwrap.dedent(line).strip()).body:
                yield place, statement
        except (SyntaxError, ValueError, RecursionError, MemoryError):
            continue


def _simple(body: list[ast.stmt], place: str) -> Iterator[tuple[str, ast.stmt]]:
    for statement in body:
        inner = [getattr(statement, name, []) for name in ("body", "orelse", "finalbody")]
        inner += [handler.body for handler in getattr(statement, "handlers", [])]
        if not any(inner):
            yield place, statement
            continue
        named = isinstance(statement, (ast.FunctionDef, ast.ClassDef)) and statement.name != "__init__"
        for part in inner:
            yield from _simple(part, statement.name if named else place)  # type: ignore[attr-defined]


def _logical_lines(text: str) -> Iterator[str]:
    """Yield lines joined until their brackets are closed."""
    held, depth = "", 0
    for line in text.splitlines():
        code = line.split("#")[0]
        held = f"{held} {code.strip()}" if depth > 0 else code
        depth += sum(code.count(sign) for sign in "([{") - sum(code.count(sign) for sign in ")]}")
        if depth <= 0:
            yield held
            held, depth = "", 0


def _take(statement: ast.stmt, place: str, known: dict[str, Any], found: list[_Found]) -> None:
    """Take from one statement what belongs to a motion."""
    if isinstance(statement, ast.Assign) and len(statement.targets) == 1:
        name = _last_name(statement.targets[0])
        try:
            value = _value(statement.value, known)
        except _NotConstant:
            value = None
        if isinstance(statement.targets[0], ast.Name) and value is not None:
            known[name] = value
        role = _ROLES.get(name.lower())
        if role is not None and isinstance(value, list):
            if found[-1].lists.get(role) or found[-1].place != place:
                found.append(_Found(place))
            found[-1].lists[role] = list(value)
            known[name] = found[-1].lists[role]
    elif isinstance(statement, (ast.Expr, ast.Return)) and isinstance(statement.value, ast.Call):
        _take_call(statement.value, place, known, found)


def _take_call(call: ast.Call, place: str, known: dict[str, Any], found: list[_Found]) -> None:
    method = _last_name(call.func)
    if method in ("append", "extend") and isinstance(call.func, ast.Attribute) and len(call.args) == 1:
        role = _ROLES.get(_last_name(call.func.value).lower())
        if role is None:
            return
        try:
            value = _value(call.args[0], known)
        except _NotConstant:
            found[-1].lists.setdefault(role, []).append(None)
            return
        held = found[-1].lists.setdefault(role, [])
        held.extend(value if method == "extend" and isinstance(value, list) else [value])
    elif method in _ORDER and len(call.args) >= 3:
        try:
            given = [_value(argument, known) for argument in call.args]
        except _NotConstant:
            return
        if not any(given[0] is motion.lists.get("names") for motion in found):
            found.append(_Found(place))
        motion = next((m for m in found if m.lists.get("names") is given[0]), found[-1])
        motion.lists |= dict(zip(_ORDER[method], given, strict=False))
        if len(given) > 3 and given[3] is False:
            motion.lists["relative"] = [True]


def _last_name(node: ast.expr) -> str:
    return node.id if isinstance(node, ast.Name) else node.attr if isinstance(node, ast.Attribute) else ""


def _value(node: ast.expr, known: dict[str, Any]) -> Any:
    """Return the value of a constant expression; nothing is called but what is listed here."""
    if isinstance(node, ast.Constant) and isinstance(node.value, (bool, int, float, str)):
        return node.value
    if isinstance(node, (ast.List, ast.Tuple)):
        return [_value(entry, known) for entry in node.elts]
    if isinstance(node, ast.UnaryOp) and isinstance(node.op, (ast.USub, ast.UAdd)):
        return (-1.0 if isinstance(node.op, ast.USub) else 1.0) * _number(_value(node.operand, known))
    if isinstance(node, ast.BinOp) and isinstance(node.op, (ast.Add, ast.Sub, ast.Mult, ast.Div)):
        return _computed(node.op, _value(node.left, known), _value(node.right, known))
    if isinstance(node, ast.Attribute) or (isinstance(node, ast.Name) and node.id not in known):
        name = _last_name(node)
        constants = {"pi": math.pi, "TO_RAD": math.radians(1.0), "TO_DEG": math.degrees(1.0), "True": True}
        if name in constants:
            return constants[name]
    if isinstance(node, ast.Name) and node.id in known:
        return known[node.id]
    if isinstance(node, ast.Attribute) and node.attr in known and node.attr.lower() in _ROLES:
        return known[node.attr]
    if isinstance(node, ast.Call):
        name, values = _last_name(node.func), [_value(argument, known) for argument in node.args]
        if name in ("list", "tuple") and len(values) <= 1:
            return values[0] if values and isinstance(values[0], list) else []
        if name in ("radians", "float") and len(values) == 1:
            number = _number(values[0])
            return math.radians(number) if name == "radians" else number
    raise _NotConstant


def _computed(sign: ast.operator, left: Any, right: Any) -> Any:
    if isinstance(sign, ast.Add) and isinstance(left, list) and isinstance(right, list):
        return left + right
    a, b = _number(left), _number(right)
    if isinstance(sign, ast.Div):
        if b == 0:
            raise _NotConstant
        return a / b
    return a + b if isinstance(sign, ast.Add) else a - b if isinstance(sign, ast.Sub) else a * b


def _number(value: Any) -> float:
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        raise _NotConstant
    return float(value)


def _curves(motion: _Found, path: Path) -> dict[str, Curve]:
    names, times, keys = (motion.lists[role] for role in ("names", "times", "keys"))
    if motion.lists.get("relative"):
        raise GestureFileError(path, "its angles are changes (isAbsolute is False); write absolute angles")
    names = [names] if isinstance(names, str) else names
    times = _each(times, len(names))
    keys = _each(keys, len(names))
    if not len(names) == len(times) == len(keys):
        raise GestureFileError(path, f"has {len(names)} names, {len(times)} lists of times and {len(keys)} of keys")
    curves: dict[str, Curve] = {}
    for index, (name, at, key) in enumerate(zip(names, times, keys, strict=True)):
        where = f"names[{index}]"
        joint = checks.joint_name(str(name), path, where)
        curve = _curve(at, key, path, f"{where} ({name})")
        if joint not in curves or name == joint:
            curves[joint] = curve
    return curves


def _each(values: Any, count: int) -> list[Any]:
    """Return one list a joint: NAOqi takes one number for all, a number each, or a list each."""
    if not isinstance(values, list):
        return [[values]] * count
    if all(not isinstance(entry, list) for entry in values) and None not in values:
        return [values] if count == 1 else [[entry] for entry in values] if len(values) == count else [values] * count
    return values


def _curve(times: Any, keys: Any, path: Path, where: str) -> Curve:
    if not isinstance(times, list) or not isinstance(keys, list) or not keys or len(times) != len(keys):
        raise GestureFileError(path, f"{where} has no times and keys of one length with constant values")
    seconds = [checks.number(time, path, f"a time of {where}") for time in times]
    checks.increasing(seconds, path)
    values, handles, curved = [], np.zeros((len(keys), 2, 2)), False
    for index, key in enumerate(keys):
        parts = key if isinstance(key, list) else [key]
        values.append(checks.number(parts[0] if parts else None, path, f"key {index + 1} of {where}"))
        for side, handle in enumerate(parts[1:3]):
            if not isinstance(handle, list) or len(handle) != 3:
                raise GestureFileError(path, f"key {index + 1} of {where}: a handle is [3, seconds, radians]")
            handles[index, side] = [checks.number(part, path, f"a handle of {where}") for part in handle[1:]]
            curved = True
    return Curve(np.array(seconds), np.array(values), handles if curved else None)
