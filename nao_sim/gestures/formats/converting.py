"""Anything that moves joints as keys of joints: what ``nao-sim convert`` writes again."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

from nao_sim.gestures.errors import GestureError
from nao_sim.gestures.formats import load_motion
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.gesture import Gesture
from nao_sim.motion.curves import Curve, curves_of


def curves_of_file(source: str | Path, said: Said) -> tuple[Mapping[str, Curve], list[str]]:
    """Return the keys of a motion file or of a gesture, and what was left out.

    Files are taken at their word, at their own times; gestures (``.toml`` or of the library) that are more than angles
    joined by straight lines are written out from StandInit every 20 ms, with their easing, repetitions and legs.

    Raises:
        GestureError: it cannot be read, or is a walk.
    """
    from nao_sim.gestures.library import find_gesture, library  # the library is read with this package
    from nao_sim.gestures.preparation import written

    path = Path(source)
    if str(source) not in library() and path.suffix.lower() != ".toml" and (path.suffix or path.exists()):
        motion = load_motion(path, said)
        return motion.curves, list(motion.notes)
    gesture = find_gesture(source, fit=True, said=said)
    if gesture.walk is not None:
        raise GestureError(
            f"'{gesture.name}' is a walk: its steps depend on balance, and no table of angles carries it"
        )
    if _plain(gesture):
        return gesture.curves(), list(gesture.notes)
    notes = ["key frames, easing, repetitions and the torso are written out as angles every 20 ms"]
    return curves_of(written(gesture)), [*gesture.notes, *notes]


def _plain(gesture: Gesture) -> bool:
    """Return whether a gesture is nothing but angles joined by straight lines."""
    more = any(frame.torso or frame.rest for frame in gesture.key_frames)
    return gesture.easing == "linear" and not (more or gesture.cycle or gesture.follow_through_s)
