"""Numbers, codes and instants as people read them."""

from __future__ import annotations

import re
from collections.abc import Iterable
from fractions import Fraction

from nao_sim.game.tables.instants import instant
from nao_sim.gestures.vocabulary import vocabulary

_MANY = 12
"""More turns than these are not named one by one."""

_CONTROL = re.compile(r"[\x00-\x08\x0b\x0c\x0e-\x1f\x7f\ud800-\udfff\ufffe\uffff]")
_MONTHS = (
    "January", "February", "March", "April", "May", "June", "July", "August", "September", "October", "November",
    "December",
)  # fmt: skip


def printable(text: str) -> str:
    """Replace what neither XML nor HTML can hold."""
    return _CONTROL.sub("\ufffd", text)


def day(text: str) -> str:
    """Return the day of an ISO instant: 1 March 2027."""
    when = instant(text)
    return f"{when.day} {_MONTHS[when.month - 1]} {when.year}"


def day_and_time(text: str) -> str:
    """Return day and time of an ISO instant, on its own clock: 1 March 2027, 10:00."""
    return f"{day(text)}, {instant(text):%H:%M}"


def minutes(seconds: float) -> str:
    """Return a length of time: 14 min; below two minutes in seconds."""
    return f"{seconds:.0f} s" if seconds < 120 else f"{seconds / 60:.0f} min"


def gesture_words(name: str) -> str:
    """Return a gesture's name in words: bye right."""
    return name.replace("_", " ")


def gesture_title(name: str) -> str:
    """Return what a gesture is, as the vocabulary says; its name where that does not know it."""
    entry = vocabulary().get(name)
    return entry.title if entry else gesture_words(name)


def percent(share: Fraction | float | None) -> str:
    """Return a share in per cent; a dash for none."""
    return "–" if share is None else f"{100 * float(share):.0f} %"


def points(difference: Fraction | float) -> str:
    """Return a difference of shares in percentage points, with its sign."""
    value = round(100 * float(difference))
    return f"{'+' if value > 0 else '−' if value < 0 else '±'}{abs(value)}"


def signed(value: float) -> str:
    """Return a number with two decimals and its sign."""
    return f"{value:+.2f}".replace("-", "−")


def seconds(value: float | None) -> str:
    """Return a time in seconds; a dash for none."""
    return "–" if value is None else f"{value:.1f} s"


def listed(words: Iterable[object]) -> str:
    """Join words: 3, 5 and 7."""
    found = [str(word) for word in words]
    return " and ".join([", ".join(found[:-1]), found[-1]]) if len(found) > 1 else "".join(found)


def turns_named(numbers: Iterable[int]) -> str:
    """Name turns: Turn 3; Turns 3, 5 and 7; many are counted and the first of them named."""
    found = list(numbers)
    if len(found) > _MANY:
        return f"{len(found)} turns ({', '.join(map(str, found[:3]))}, …)"
    return f"{'Turn' if len(found) == 1 else 'Turns'} {listed(found)}"
