"""What a file does not say itself, and the person who brings it does: units, how long, which part."""

from __future__ import annotations

import math
from dataclasses import dataclass

from nao_sim.errors import did_you_mean
from nao_sim.gestures.errors import GestureError
from nao_sim.gestures.key_frames import LONGEST_S

ANGLE_UNITS = ("rad", "deg")
TIME_UNITS = {"s": 1.0, "ms": 1e-3, "us": 1e-6, "ns": 1e-9}
"""Seconds in each unit of time."""


@dataclass(frozen=True)
class Said:
    """What a person says about a motion file beside what stands in it.

    Attributes:
        angle_unit: ``"rad"`` or ``"deg"`` for angles without a unit; None: nothing was said.
        time_unit: ``"s"``, ``"ms"``, ``"us"``, ``"ns"`` or ``"frames"`` for times without a unit.
        fps: frames per second, for times in frames.
        clock: times are those of a clock (Unix time, a log): the first one is the start.
        longest_s: a motion that ends later is refused.
        part: name or number of the time line, or number of the episode, where a file holds several.
        measured: of an episode, what the joints did instead of what they were asked.
    """

    angle_unit: str | None = None
    time_unit: str | None = None
    fps: float | None = None
    clock: bool = False
    longest_s: float = LONGEST_S
    part: str | None = None
    measured: bool = False

    def __post_init__(self) -> None:
        if not (math.isfinite(self.longest_s) and self.longest_s > 0):
            raise GestureError(f"a motion may last {self.longest_s:g} s; write a positive number of seconds")


def said(
    units: str | None = None, longest_s: float | None = None, part: str | None = None, measured: bool = False
) -> Said:
    """Return what a person wrote as options.

    Args:
        units: words with commas between: ``rad`` or ``deg``; ``s``, ``ms``, ``us``, ``ns`` or ``frames@25``; ``clock``.
        longest_s, part, measured: as in :class:`Said`; None for its default.

    Raises:
        GestureError: an unknown word, or two for one thing.

    Example:
        >>> said("rad,frames@25").fps
        25.0
    """
    known = (*ANGLE_UNITS, *TIME_UNITS, "frames@25", "clock")
    angle, time, fps, clock = None, None, None, False
    for word in (units or "").replace(" ", "").split(","):
        name, _, rate = word.partition("@")
        if not word:
            continue
        if name in ANGLE_UNITS and angle in (None, name) and not rate:
            angle = name
        elif ((name in TIME_UNITS and not rate) or name == "frames") and time in (None, name):
            time = name
            fps = _rate(rate) if name == "frames" else None
        elif word == "clock":
            clock = True
        else:
            twice = name in (*ANGLE_UNITS, *TIME_UNITS, "frames") and not (rate and name != "frames")
            why = "says a second unit for one thing; keep one" if twice else f"is no unit{did_you_mean(word, known)}"
            raise GestureError(f"--units: '{word}' {why}")
    longest = LONGEST_S if longest_s is None else longest_s
    return Said(angle, time, fps, clock, longest, part, measured)


def _rate(text: str) -> float:
    try:
        rate = float(text)
    except ValueError:
        rate = math.nan
    if not 0 < rate <= 10_000:
        raise GestureError("--units: write frames with their number in a second, as in 'frames@25'")
    return rate
