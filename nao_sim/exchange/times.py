"""Times as other tools write them: whole milliseconds, and the clock's ``hh:mm:ss.mmm``."""

from __future__ import annotations

import math
import re

_CLOCK = re.compile(r"(?:(\d+):)?(\d{1,3}):(\d{1,2}(?:[.,]\d+)?)")


def milliseconds(seconds: float) -> int:
    """Return whole milliseconds, halves upwards, never below 0."""
    return max(0, math.floor(seconds * 1000 + 0.5))


def clock(seconds: float) -> str:
    """Return ``hh:mm:ss.mmm``."""
    ms = milliseconds(seconds)
    return f"{ms // 3_600_000:02}:{ms // 60_000 % 60:02}:{ms // 1000 % 60:02}.{ms % 1000:03}"


def seconds_of(text: str, decimal: str = ".") -> float:
    """Return seconds from plain seconds or from ``hh:mm:ss.mmm``, ``mm:ss.mmm``.

    Args:
        text: the time.
        decimal: the sign before the decimals of plain seconds; on a clock both are understood.

    Raises:
        ValueError: it is neither.
    """
    text = text.strip()
    found = _CLOCK.fullmatch(text)
    if found:
        hours, minutes, rest = found.groups()
        if float(rest.replace(",", ".")) >= 60 or (hours is not None and int(minutes) >= 60):
            raise ValueError(f"{text!r} is no time of a clock")
        return int(hours or 0) * 3600 + int(minutes) * 60 + float(rest.replace(",", "."))
    return number_of(text, decimal)


def number_of(text: str, decimal: str = ".") -> float:
    """Return a number written with a decimal point or comma; thousands are not grouped.

    Raises:
        ValueError: it is none, or not finite.
    """
    text = text.strip()
    if not re.fullmatch(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?", text):
        raise ValueError(f"{text!r} is no number")
    if decimal == "." and "," in text:
        raise ValueError(f"{text!r} has a decimal comma")
    value = float(text.replace(",", "."))
    if not math.isfinite(value):
        raise ValueError(f"{text!r} is no finite number")
    return value
