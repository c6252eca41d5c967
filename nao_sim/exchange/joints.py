"""A child's joints from a table of a body tracker: one line a sample, columns ``time`` and ``<joint>.x`` and so on."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise

from nao_sim.exchange.csv_dialects.reading import Sheet
from nao_sim.exchange.csv_dialects.rows import MISSING
from nao_sim.exchange.dream import JOINTS, ChildTrack, JointTrack, Samples
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.times import number_of, seconds_of

_AXES = ("x", "y", "z", "confidence")
_UNEVEN = 0.1
"""Intervals that differ so far from their mean have no frame rate."""


def track_from(sheet: Sheet, metres: bool = False) -> ChildTrack:
    """Return what a table of joints says.

    Columns are ``time`` (or ``time_s``), and for each joint that was tracked ``head.x``, ``head.y``, ``head.z`` and,
    where there is one, ``head.confidence``; ``head_gaze.rx`` … and ``eye_gaze.rx`` … likewise. A missing cell is a
    sample that was not seen.

    Args:
        sheet: the table.
        metres: whether positions are metres instead of millimetres.

    Raises:
        ExchangeError: no time, no joint, a cell that is no number, or times without a steady rate.
    """
    columns = {name.casefold().replace("shoulder", "sholder"): i for i, name in enumerate(sheet.columns)}
    time = columns.get("time", columns.get("time_s"))
    if time is None or len(sheet.rows) < 2:
        raise ExchangeError(f"{sheet.where} needs a column 'time' and two samples at least")
    joints = {}
    for joint in JOINTS:
        if any(f"{joint}.{axis}" in columns for axis in _AXES[:3]):
            rows = {axis: _column(sheet, columns, f"{joint}.{axis}", metres and axis != "confidence") for axis in _AXES}
            joints[joint] = JointTrack(**rows)
    gaze = {name: _gaze(sheet, columns, name) for name in ("head_gaze", "eye_gaze")}
    if not joints and not any(gaze.values()):
        raise ExchangeError(
            f"{sheet.where} has no joint that DREAM knows (such as head.x); it knows {', '.join(JOINTS)}"
        )
    return ChildTrack(_rate(sheet, time), joints, gaze["head_gaze"], gaze["eye_gaze"])


def _column(sheet: Sheet, columns: Mapping[str, int], name: str, metres: bool) -> Samples:
    place = columns.get(name)
    if place is None:
        return [None] * len(sheet.rows)
    found: list[float | None] = []
    for line, cells in sheet.rows:
        text = cells[place].strip()
        try:
            value = None if text in MISSING else number_of(text, sheet.dialect.decimal)
        except ValueError as error:
            raise ExchangeError(f"{sheet.where} line {line}: {name}: {error}") from None
        found.append(None if value is None else 1000 * value if metres else value)
    return found


def _gaze(sheet: Sheet, columns: Mapping[str, int], name: str) -> tuple[Samples, Samples, Samples] | None:
    if not any(f"{name}.{axis}" in columns for axis in ("rx", "ry", "rz")):
        return None
    x, y, z = (_column(sheet, columns, f"{name}.{axis}", False) for axis in ("rx", "ry", "rz"))
    return x, y, z


def _rate(sheet: Sheet, place: int) -> float:
    times = []
    for line, cells in sheet.rows:
        try:
            times.append(seconds_of(cells[place], sheet.dialect.decimal))
        except ValueError as error:
            raise ExchangeError(f"{sheet.where} line {line}: time: {error}") from None
    steps = [b - a for a, b in pairwise(times)]
    mean = (times[-1] - times[0]) / len(steps)
    if mean <= 0 or max(abs(step - mean) for step in steps) > _UNEVEN * mean + 0.001:
        raise ExchangeError(
            f"{sheet.where}: the samples are not evenly spaced in time, DREAM knows one frame rate only"
        )
    return round(1 / mean, 4)
