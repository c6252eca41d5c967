"""Choregraphe's time lines: ``.xar`` behaviours, ``.pml`` projects, and animations of their own.

A time line has its frames per second (25 as a rule) and a curve an actuator, in degrees (``unit`` 0 or ``degree``),
radians or, for hands, fractions (1 or ``dimensionless``); keys may have Bezier tangents in frames and the curve's
unit. Keys without tangents are joined by straight lines. Files are read as plain XML: no document type, no entities,
nothing fetched.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import numpy as np

from nao_sim.errors import did_you_mean
from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text, write_whole
from nao_sim.gestures.formats.units import angles_in_rad, joint_scale
from nao_sim.motion.curves import Curve
from nao_sim.motion.limits import HANDS, unit_of

FPS = 25.0
_MAX_BYTES = 16_000_000
_UNITS = {"0": "deg", "degree": "deg", "1": "fraction", "dimensionless": "fraction", "radian": "rad", "2": "rad"}
_YES = ("1", "true")


@dataclass(frozen=True)
class _TimeLine:
    name: str
    fps: str | None
    curves: list[Element]


def read(path: Path, said: Said) -> MotionFile:
    """Read a time line; of a project, the one of its behaviour.

    Raises:
        GestureFileError: no time line in it, several of them and none chosen, or a curve that is not one.
    """
    root = _parse(path)
    lines = _project(root, path) if _tag(root) == "Package" else _time_lines(root)
    if not lines:
        raise GestureFileError(path, "has no time line with joint curves")
    line = _chosen(lines, path, said)
    notes: dict[str, None] = {}
    if _tag(root) in ("Package", "ChoregrapheProject"):
        notes["of the behaviour only the time line is read; boxes, scripts, sounds and stiffness are left out"] = None
    curves: dict[str, Curve] = {}
    for element in line.curves:
        name = element.get("actuator", "")
        if element.get("mute", "0").lower() in _YES:
            notes[f"{name} is muted and left out"] = None
            continue
        joint = checks.joint_name(name, path, f"time line '{line.name}'")
        keys = [entry for entry in element if _tag(entry) == "Key"]
        if not keys:
            continue
        curve, told = _curve(element, keys, joint, line, path, said)
        notes |= dict.fromkeys(told)
        if joint not in curves or name == joint:
            curves[joint] = curve
    if not curves:
        raise GestureFileError(path, f"time line '{line.name}' moves no joint")
    checks.not_too_long(max(float(curve.times[-1]) for curve in curves.values()), path, said.longest_s)
    return MotionFile(path, curves, tuple(notes))


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a behaviour that is one time line of 25 frames a second, a key a frame."""
    last = max(float(curve.times[-1]) for curve in curves.values())
    frames = int(np.ceil(last * FPS - 1e-9)) + 1
    root = Element(
        "ChoregrapheProject", xmlns="http://www.aldebaran-robotics.com/schema/choregraphe/project.xsd", xar_version="3"
    )
    box = ElementTree.SubElement(root, "Box", name=path.stem, id="-1", localization="8", tooltip="", x="0", y="0")
    line = ElementTree.SubElement(
        box, "Timeline", enable="1", fps=f"{FPS:g}", start_frame="1", end_frame="-1", size=str(frames + 1)
    )
    actuators = ElementTree.SubElement(line, "ActuatorList", model="")
    moved = False
    for name, curve in curves.items():
        unit = "1" if name in HANDS else "0"
        element = ElementTree.SubElement(
            actuators, "ActuatorCurve", name="value", actuator=name, recordable="0", mute="0", unit=unit
        )
        straight = curve.straight(1 / FPS)
        at = np.unique(np.round(straight.times * FPS).astype(int))
        dense = (
            len(straight.times) > len(at) or np.abs(straight.times * FPS - np.round(straight.times * FPS)).max() > 1e-3
        )
        moved = moved or bool(dense)
        values = np.interp(at / FPS, straight.times, straight.values) * unit_of(name)[1]
        for frame, value in zip(at.tolist(), values.tolist(), strict=True):
            ElementTree.SubElement(element, "Key", frame=str(frame), value=f"{value:.6g}")
    ElementTree.indent(root)
    write_whole(path, f'<?xml version="1.0" encoding="UTF-8" ?>\n{ElementTree.tostring(root, encoding="unicode")}\n')
    return ["keys stand on frames of 1/25 s there"] if moved else []


def _parse(path: Path) -> Element:
    text = read_text(path, _MAX_BYTES)
    if "<!DOCTYPE" in text or "<!ENTITY" in text:
        raise GestureFileError(path, "has a document type; Choregraphe's files have none")
    try:
        return ElementTree.fromstring(text)
    except (ElementTree.ParseError, ValueError, RecursionError) as error:
        line, column = getattr(error, "position", (1, 0))
        raise GestureFileError(path, f"line {line}, column {column + 1}: is not XML ({error})") from None


def is_motion(text: str) -> bool:
    """Return whether a text looks like a file with a time line."""
    return "<ActuatorCurve" in text or "<BehaviorDescription" in text


def _tag(element: Element) -> str:
    return element.tag.rpartition("}")[2]


def _time_lines(root: Element) -> list[_TimeLine]:
    """Return the time lines with curves, each named after the box that it stands in."""
    found: list[_TimeLine] = []
    waiting: list[tuple[Element, str, _TimeLine | None]] = [(root, "", None)]
    while waiting:
        element, box, line = waiting.pop()
        tag = _tag(element)
        if tag == "Box":
            box = element.get("name") or box
        if tag in ("Timeline", "Animation"):
            line = _TimeLine(box or element.get("name", "") or tag, element.get("fps"), [])
            found.append(line)
        if tag == "ActuatorCurve":
            if line is None:
                found.append(line := _TimeLine(box or "curves", None, []))
            line.curves.append(element)
            continue
        waiting.extend((child, box, line) for child in reversed(element))
    return [line for line in found if any(_tag(key) == "Key" for curve in line.curves for key in curve)]


def _project(root: Element, path: Path) -> list[_TimeLine]:
    """Return the time lines of a project's behaviours."""
    found = []
    for entry in root.iter():
        if _tag(entry) != "BehaviorDescription":
            continue
        behaviour = path.parent / entry.get("src", ".") / entry.get("xar", "behavior.xar")
        if not behaviour.resolve().is_relative_to(path.parent.resolve()):
            raise GestureFileError(
                path, f"names a behaviour outside its folder ({entry.get('src')}); name the .xar itself"
            )
        found += _time_lines(_parse(behaviour))
    return found


def _chosen(lines: list[_TimeLine], path: Path, said: Said) -> _TimeLine:
    if said.part is None:
        if len(lines) == 1:
            return lines[0]
        shown = ", ".join(f"{number} ({line.name})" for number, line in enumerate(lines[:12], start=1))
        more = ", …" if len(lines) > 12 else ""
        raise GestureFileError(path, f"holds {len(lines)} time lines; choose one with --part: {shown}{more}")
    for number, line in enumerate(lines, start=1):
        if said.part == str(number):
            return line
    named = [line for line in lines if line.name == said.part]
    if len(named) == 1:
        return named[0]
    why = f"has {len(named)} parts '{said.part}'; choose by number" if named else f"has no part '{said.part}'"
    raise GestureFileError(path, why + ("" if named else did_you_mean(said.part, [line.name for line in lines])))


def _curve(
    element: Element, keys: list[Element], joint: str, line: _TimeLine, path: Path, said: Said
) -> tuple[Curve, list[str]]:
    where = f"curve of {joint}"
    # fps stands at the time line, in newer files at each curve.
    fps = _number(element.get("fps") or line.fps or str(said.fps or FPS), path, f"fps of the {where}")
    if not 0 < fps <= 10_000:
        raise GestureFileError(path, f"fps of the {where} is {fps:g}; write frames per second")
    unit = _UNITS.get(element.get("unit", ""))
    scale = joint_scale(None if unit == "deg" and joint in HANDS else unit, joint, path, where)
    frames = np.array([_number(key.get("frame"), path, f"frame in the {where}") for key in keys])
    values = np.array([_number(key.get("value"), path, f"value in the {where}") for key in keys])
    order = np.argsort(frames, kind="stable")
    angles, told = angles_in_rad([joint], [scale], values[:, None], path, said)
    factor = scale or (float(np.deg2rad(1.0)) if told or said.angle_unit != "rad" else 1.0)
    handles = np.zeros((len(keys), 2, 2))
    curved = False
    for row, key in enumerate(keys):
        for tangent in key:
            if _tag(tangent) != "Tangent" or tangent.get("interpType", "").startswith(("linear", "constant")):
                continue
            offset = (_number(tangent.get(f"{name}Param", "0"), path, where) for name in ("abscissa", "ordinate"))
            handles[row, 0 if tangent.get("side") == "left" else 1] = next(offset) / fps, next(offset) * factor
            curved = True
    times = frames[order] / fps
    checks.increasing(times.tolist(), path)
    return Curve(times, angles[order, 0], handles[order] if curved else None), told


def _number(text: str | None, path: Path, where: str) -> float:
    try:
        return checks.number(float(text or ""), path, where)
    except ValueError:
        raise GestureFileError(path, f"{where} is '{text}'; write a finite number") from None
