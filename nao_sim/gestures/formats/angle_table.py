"""Tables of joint angles as CSV: a time column and a column a joint.

The first line names the columns: a time (``time_s``, ``time_ms``, ``timestamp [us]``, ``frames`` …) and NAOqi joints
with their unit (``HeadYaw_rad``, ``HeadYaw (deg)``); hands are fractions open, or ``RHand_percent``. A second line
may hold units instead. Columns are parted by commas, semicolons, tabs or blanks; where no comma parts them, one may
stand for the decimal point. An empty cell gives a joint no key at that time. Lines that begin with ``#`` are
comments.
"""

from __future__ import annotations

import csv
import io
import math
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile, of_rows
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import read_text, write_whole
from nao_sim.gestures.formats.units import UNIT_OF, angles_in_rad, joint_scale, split_header, time_column, times_in_s
from nao_sim.motion.curves import Curve, rows_of, union_of_times
from nao_sim.motion.limits import HANDS, unit_of

_HEADER = "write 'time_s,HeadYaw_rad,...' first"


@dataclass(frozen=True)
class _Line:
    number: int
    cells: list[str]


def read(path: Path, said: Said) -> MotionFile:
    """Read a table of joint angles.

    Raises:
        GestureFileError: not such a table, with line and column of what is wrong.
    """
    lines, delimiter = _lines(read_text(path))
    if not lines:
        raise GestureFileError(path, f"has no header line; {_HEADER}")
    header, body = lines[0], lines[1:]
    units: list[str | None] = [None] * len(header.cells)
    if body and _is_units(body[0].cells):
        units = [UNIT_OF.get(cell.lower()) for cell in body[0].cells]
        body = body[1:]
    at = _time_place(header, path)
    place = {index: cell for index, cell in enumerate(header.cells) if index != at and not (index < at and not cell)}
    names, scales = [], []
    for index, cell in place.items():
        where = f"line {header.number}, column {index + 1}"
        name, unit = split_header(cell)
        names.append(checks.joint_name(name, path, where))
        unit = unit or (units[index] if index < len(units) else None)
        scales.append(joint_scale(unit, names[-1], path, where))
    _once(names, path)
    rows = np.array([[_cell(line, index, header, delimiter, path) for index in (at, *place)] for line in body])
    rows = rows.reshape(len(body), len(place) + 1)
    for line, time in zip(body, rows[:, 0], strict=True):
        if math.isnan(time):
            raise GestureFileError(path, f"line {line.number}, column {at + 1}: has no time")
    unit = time_column(header.cells[at])[1] or (units[at] if at < len(units) else None)
    times, told = times_in_s(rows[:, 0], unit, path, said)
    angles, concluded = angles_in_rad(names, scales, rows[:, 1:], path, said)
    return of_rows(path, names, times, angles, [*told, *concluded], [line.number for line in body])


def _is_units(cells: list[str]) -> bool:
    """Return whether a line holds units; a lone 1, which stands for fractions, may as well be a number."""
    words = [cell.lower() for cell in cells if cell]
    return all(word in UNIT_OF for word in words) and any(word not in ("1", "") for word in words)


def is_table(text: str) -> bool:
    """Return whether a text begins like a table of joint angles."""
    lines, _ = _lines(text)
    if not lines:
        return False
    names = [split_header(cell)[0] for cell in lines[0].cells]
    return any(time_column(cell)[0] for cell in lines[0].cells) and any(name in checks.BODY for name in names)


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion as a table in degrees, a row a key; cells are empty outside a joint's own keys."""
    times = union_of_times({name: curve.straight() for name, curve in curves.items()})
    out = io.StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(["time_s", *(name if name in HANDS else f"{name}_deg" for name in curves)])
    scale = np.array([unit_of(name)[1] for name in curves])
    digits = 3 if np.abs(times - times.round(3)).max() < 1e-7 else 6
    for time, row in zip(times, rows_of(curves, times) * scale, strict=True):
        writer.writerow([f"{time:.{digits}f}", *("" if math.isnan(value) else f"{value:.5f}" for value in row)])
    write_whole(path, out.getvalue())
    return []


def _lines(text: str) -> tuple[list[_Line], str | None]:
    """Return the lines that hold something, trailing empty cells left out of the header, and what parts the cells."""
    kept = [(number, line) for number, line in enumerate(text.splitlines(), start=1) if line.strip(" \t,;")]
    kept = [(number, line) for number, line in kept if not line.lower().startswith("sep=")]
    if kept and kept[0][1].lstrip().startswith("#") and _is_header(kept[0][1].lstrip(" #")):
        kept[0] = (kept[0][0], kept[0][1].lstrip(" #"))
    kept = [(number, line) for number, line in kept if not line.lstrip().startswith("#")]
    if not kept:
        return [], None
    delimiter = next((sign for sign in ";\t," if sign in kept[0][1]), None)
    lines = [_Line(number, _cells(line, delimiter)) for number, line in kept]
    while lines[0].cells and not lines[0].cells[-1]:
        lines[0].cells.pop()
    return lines, delimiter


def _is_header(line: str) -> bool:
    first = next((sign for sign in ";\t," if sign in line), None)
    return time_column(_cells(line, first)[0])[0]


def _cells(line: str, delimiter: str | None) -> list[str]:
    cells = line.split() if delimiter is None else next(csv.reader([line], delimiter=delimiter), [])
    return [cell.strip() for cell in cells]


def _time_place(header: _Line, path: Path) -> int:
    places = [index for index, cell in enumerate(header.cells) if time_column(cell)[0]]
    if not places:
        shown = header.cells[0] if header.cells else ""
        raise GestureFileError(path, f"has no header line with a time (line {header.number}: '{shown}'); {_HEADER}")
    if len(places) > 1:
        raise GestureFileError(
            path, f"line {header.number}, column {places[1] + 1}: a second column of times; keep one"
        )
    return places[0]


def _once(names: list[str], path: Path) -> None:
    if not names:
        raise GestureFileError(path, f"names no joint; {_HEADER}")
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice is not None:
        raise GestureFileError(path, f"has two columns for {twice}; keep one")


def _cell(line: _Line, index: int, header: _Line, delimiter: str | None, path: Path) -> float:
    """Return the number in a cell, NaN if it is empty."""
    used = len(line.cells)
    while used and not line.cells[used - 1]:
        used -= 1
    if used > len(header.cells) or len(line.cells) < len(header.cells):
        raise GestureFileError(
            path,
            f"line {line.number} has {max(used, 1)} cells, the header (line {header.number}) has {len(header.cells)}",
        )
    cell = line.cells[index]
    if not cell:
        return math.nan
    try:
        if "_" in cell:
            raise ValueError
        number = float(cell.replace("−", "-").replace(",", ".") if delimiter != "," else cell.replace("−", "-"))
        if math.isfinite(number):
            return number
    except ValueError:
        pass
    where = f"line {line.number}, column {index + 1} ({header.cells[index]})"
    raise GestureFileError(path, f"{where}: '{cell}' is not a number; leave the cell empty where there is none")
