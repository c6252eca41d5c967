"""The library: every gesture in ``assets/gestures/``, and the mirror twins of those that have one."""

from __future__ import annotations

from functools import cache
from pathlib import Path

from nao_sim.gestures.errors import UnknownGesture
from nao_sim.gestures.formats import Said, load_gesture
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.mirror import mirrored
from nao_sim.gestures.vocabulary import FAMILIES
from nao_sim.resources import resource
from nao_sim.robot.joints import joint_table


@cache
def _library() -> dict[str, Gesture]:
    written = [load_gesture(path) for path in sorted(resource("assets", "gestures").glob("*.toml"))]
    gestures = {gesture.name: gesture for gesture in written}
    for gesture in written:
        gestures.setdefault(gesture.mirror, mirrored(gesture))
    return {gesture.name: gesture for gesture in sorted(gestures.values(), key=_place)}


def _place(gesture: Gesture) -> tuple[int, float, str]:
    """Return the place in the table: by family, then the thesis's number, then the derived and the added ones."""
    number = float("inf") if gesture.number is None else gesture.number
    return FAMILIES.index(gesture.family), number, gesture.name


def library() -> dict[str, Gesture]:
    """Return all gestures by name: static, small, large (each in the thesis's order), then those for games."""
    return dict(_library())


def find_gesture(
    name_or_file: str | Path, fit: bool = False, limits: str = "thesis", said: Said | None = None
) -> Gesture:
    """Return a library gesture by name, or read a gesture file of any known format.

    Args:
        name_or_file: a name such as ``bye_right``, or a path with a suffix such as ``own.toml``.
        fit: leave angles outside their range for fitting to clip, instead of refusing them.
        limits: the range set that a file must keep: ``"thesis"``, ``"v5"`` or ``"envelope"``.
        said: what a file does not say itself: units, how long, which part.

    Raises:
        UnknownNameError: no such range set.
        UnknownGesture: no gesture has that name; suggests the nearest.
        GestureFileError: the file cannot be read as a gesture.
    """
    joint_table().range_rad(limits)
    known = _library()
    text = str(name_or_file)
    if text in known:
        return known[text]
    path = Path(text)
    if path.suffix or path.exists() or len(path.parts) > 1:
        return load_gesture(path, fit, limits, said)
    raise UnknownGesture(text, list(known))
