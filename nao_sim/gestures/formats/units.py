"""Units of table columns: said by the header, said by the person, or seen to be impossible otherwise; never assumed."""

from __future__ import annotations

import datetime
import re
from collections.abc import Sequence
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.said import TIME_UNITS, Said
from nao_sim.motion.limits import HANDS

# No joint of a NAO turns further than 2.1 rad: a table whose angles all lie within this is not one in degrees.
MOST_RAD = 3.2

_WORDS = {
    "rad": ("rad", "rads", "radian", "radians"),
    "deg": ("deg", "degs", "degree", "degrees", "°"),
    "fraction": ("fraction", "1", "open"),
    "percent": ("%", "percent"),
    "s": ("s", "sec", "secs", "second", "seconds"),
    "ms": ("ms", "msec", "msecs", "millisecond", "milliseconds"),
    "us": ("us", "µs", "μs", "usec", "microsecond", "microseconds"),
    "ns": ("ns", "nsec", "nanosecond", "nanoseconds"),
    "frames": ("frame", "frames"),
}
UNIT_OF = {word: unit for unit, words in _WORDS.items() for word in words}
"""What people write in a header → the unit."""

_TIME = ("time", "times", "t", "timestamp", "timestamps", "stamp", "elapsed")
_BRACKETED = re.compile(r"(.*?)[\s_]*[\[(]\s*([^\])]*?)\s*[\])]")
_SUFFIXED = re.compile(r"(.+?)[\s_./]+([^\s_./]+)")

# So far apart, in seconds, no rows of a moving robot are: few rows, many rows.
_APART_S, _APART_MANY_S, _MANY = 10.0, 3.0, 8
_UNIX_S = 1e8
_FPS_MEND = "say how many a second with --units frames@25, or write a column time_s"


def split_header(cell: str) -> tuple[str, str | None]:
    """Return a column's name and the unit that its header says (None: none), a word of :data:`UNIT_OF` or unknown.

    Example:
        >>> split_header("HeadYaw (rad)"), split_header("time_ms"), split_header("HeadYaw")
        (('HeadYaw', 'rad'), ('time', 'ms'), ('HeadYaw', None))
    """
    cell = cell.strip()
    bracketed = _BRACKETED.fullmatch(cell)
    if bracketed and bracketed[1]:
        return bracketed[1].strip(), UNIT_OF.get(bracketed[2].lower(), bracketed[2])
    suffixed = _SUFFIXED.fullmatch(cell)
    if suffixed and suffixed[2].lower() in UNIT_OF:
        return suffixed[1], UNIT_OF[suffixed[2].lower()]
    return cell, None


def time_column(cell: str) -> tuple[bool, str | None]:
    """Return whether a header is that of the times, and the unit that it says."""
    name, unit = split_header(cell)
    if name.lower() in _TIME:
        return True, unit
    alone = UNIT_OF.get(name.lower())
    if alone in TIME_UNITS or alone == "frames":
        return True, alone if unit is None else unit
    return False, None


def joint_scale(unit: str | None, joint: str, path: Path, where: str) -> float | None:
    """Return the factor from a column's unit to rad (hands: fraction); None: the unit is not known.

    Raises:
        GestureFileError: not a unit of that joint.
    """
    if joint in HANDS:
        scales = {None: 1.0, "fraction": 1.0, "percent": 0.01}
        known = "a fraction from 0 closed to 1 open, or percent"
    else:
        scales = {"rad": 1.0, "deg": float(np.deg2rad(1.0))}
        known = "rad or deg"
    if unit not in scales and unit is not None:
        raise GestureFileError(path, f"{where}: unit '{unit}' of {joint} is not known; write {known}")
    return scales.get(unit)


def angles_in_rad(
    columns: Sequence[str], scales: Sequence[float | None], rows: NDArray[np.float64], path: Path, said: Said
) -> tuple[NDArray[np.float64], list[str]]:
    """Return a table's angles in rad (hands: fraction), and a note where a unit had to be concluded.

    Args:
        columns: joint names, length k.
        scales: factor of each to rad, None where no unit is known.
        rows: as written, shape (n, k).

    Raises:
        GestureFileError: angles without a unit that may be either.
    """
    bare = [index for index, scale in enumerate(scales) if scale is None]
    unit, notes = said.angle_unit, []
    most = float(np.nanmax(np.abs(rows[:, bare]), initial=0.0)) if bare else 0.0
    if bare and unit is None and most > 0.0:
        names = columns[bare[0]] if len(bare) == 1 else f"{columns[bare[0]]} and {len(bare) - 1} more columns"
        if most <= MOST_RAD:
            raise GestureFileError(
                path,
                f"{names}: no unit, and no angle beyond ±{MOST_RAD:g}: radians? Name columns "
                f"'{columns[bare[0]]}_rad' or '{columns[bare[0]]}_deg', or pass --units rad or --units deg",
            )
        notes.append(f"{names}: no unit; taken as degrees, since they go to {most:g}")
    bare_scale = 1.0 if unit == "rad" else float(np.deg2rad(1.0))
    return rows * np.array([bare_scale if scale is None else scale for scale in scales]), notes


def times_in_s(
    times: NDArray[np.float64], unit: str | None, path: Path, said: Said
) -> tuple[NDArray[np.float64], list[str]]:
    """Return a table's times in seconds from its start, and a note where the unit had to be concluded.

    Args:
        times: as written, shape (n,).
        unit: what the header says.
        said: what the person says; the header goes first.

    Raises:
        GestureFileError: frames without a rate, times that are no seconds, a motion without end.
    """
    if unit is not None and unit not in TIME_UNITS and unit != "frames":
        raise GestureFileError(path, f"times have the unit '{unit}'; write s, ms, us, ns or frames")
    if not len(times):
        return times, []
    unit, notes = unit or said.time_unit, []
    if unit == "frames":
        if said.fps is None:
            raise GestureFileError(path, f"line 1, the column of frames: nobody says how many a second; {_FPS_MEND}")
        seconds = times / said.fps
    else:
        seconds = times * TIME_UNITS[unit or "s"]
    if said.clock:
        seconds = seconds - seconds[0]
    elif unit is None:
        _plausible_seconds(seconds, path)
        notes.append(f"times have no unit; taken as seconds, it ends at {seconds[-1]:g} s")
    checks.not_too_long(float(seconds[-1]), path, said.longest_s, float(seconds[0]))
    return seconds, notes


def _plausible_seconds(seconds: NDArray[np.float64], path: Path) -> None:
    """Refuse times without a unit that cannot be seconds from the start."""
    if abs(seconds[0]) >= _UNIX_S:
        stamp = seconds[0] * 10.0 ** -(3 * max(0, round((np.log10(abs(seconds[0])) - 9) / 3)))
        day = datetime.datetime.fromtimestamp(stamp, datetime.UTC).strftime("%Y-%m-%d %H:%M")
        raise GestureFileError(
            path,
            f"starts at {seconds[0]:.15g}: times of a clock ({day})? times count from the start; pass --units clock",
        )
    lasts = checks.in_words(float(seconds[-1]))
    apart = float(np.median(np.diff(seconds))) if len(seconds) > 1 else float(seconds[0])
    if apart >= _APART_S or (apart >= _APART_MANY_S and len(seconds) >= _MANY):
        guess = "us" if apart >= 5e3 else "ms"
        guess = "ns" if apart >= 2e6 else guess
        raise GestureFileError(
            path,
            f"lasts {lasts}; times are seconds. If these are {guess}, name the column 'time_{guess}' or pass "
            f"--units {guess}; if they are seconds, name it 'time_s'",
        )
    if seconds[0] >= _APART_S:
        raise GestureFileError(
            path,
            f"starts at {seconds[0]:g} s; if that is a clock's time, pass --units clock to start with the first row; "
            "if the robot shall wait so long, name the column 'time_s'",
        )
