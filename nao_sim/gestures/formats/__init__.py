"""Motions in the formats that NAO people have; a module a format, imported when a file asks for it."""

from __future__ import annotations

import importlib
import json
from collections.abc import Callable, Mapping
from pathlib import Path

from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile
from nao_sim.gestures.formats.said import Said, said
from nao_sim.gestures.formats.text_file import read_text
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.loader import load_toml_gesture
from nao_sim.motion.curves import Curve, curves_of
from nao_sim.motion.trajectory import Trajectory

_HERE = "nao_sim.gestures.formats"
READERS = {
    ".motion": f"{_HERE}.webots_motion",
    ".csv": f"{_HERE}.angle_table",
    ".tsv": f"{_HERE}.angle_table",
    ".txt": f"{_HERE}.angle_table",
    ".py": f"{_HERE}.naoqi_keys",
    ".xar": f"{_HERE}.choregraphe",
    ".pml": f"{_HERE}.choregraphe",
    ".xml": f"{_HERE}.choregraphe",
    ".qianim": f"{_HERE}.choregraphe",
    ".pos": f"{_HERE}.runswift_pos",
    ".json": f"{_HERE}.hulks_json",
    ".parquet": f"{_HERE}.parquet_table",
    # Rerun is not for this package to import: the reader stands above it, with the other code for recordings.
    ".rrd": "nao_sim.recording.motion",
}
"""Suffix → module whose ``read(path, said)`` returns a :class:`MotionFile`; ``.toml`` is read as a gesture."""

WRITERS = {
    ".motion": f"{_HERE}.webots_motion",
    ".csv": f"{_HERE}.angle_table",
    ".py": f"{_HERE}.naoqi_script",
    ".xar": f"{_HERE}.choregraphe",
    ".pos": f"{_HERE}.runswift_pos",
    ".json": f"{_HERE}.hulks_json",
    ".parquet": f"{_HERE}.parquet_table",
    ".toml": f"{_HERE}.own_toml",
}
"""Suffix → module whose ``write(curves, path)`` writes a motion and returns what it could not carry over."""

SUFFIXES = (".toml", *READERS)
"""Every suffix that is read."""

__all__ = [
    "READERS",
    "SUFFIXES",
    "WRITERS",
    "MotionFile",
    "Said",
    "holds_a_motion",
    "load_gesture",
    "load_motion",
    "said",
    "save_curves",
    "save_trajectory",
]


def load_motion(path: str | Path, said: Said | None = None) -> MotionFile:
    """Read a motion file as it is, whatever ranges it keeps; the suffix says its format.

    Args:
        path: any of :data:`READERS`.
        said: what the file does not say itself.

    Raises:
        GestureFileError: unknown suffix, or the file cannot be read as a motion.
    """
    path = Path(path)
    module = READERS.get(path.suffix.lower())
    if module is None:
        raise GestureFileError(path, f"unknown suffix '{path.suffix}'; known: {', '.join(SUFFIXES)}")
    motion: MotionFile = importlib.import_module(module).read(path, said or Said())
    return motion


def load_gesture(path: str | Path, fit: bool = False, limits: str = "thesis", said: Said | None = None) -> Gesture:
    """Read a gesture file; the suffix says its format.

    Args:
        path: ``.toml`` (own format), or any of :data:`READERS`.
        fit: leave angles outside their range for fitting to clip, instead of refusing them.
        limits: the range set that it must keep: ``"thesis"``, ``"v5"`` or ``"envelope"``.
        said: what the file does not say itself.

    Raises:
        GestureFileError: unknown suffix, the file cannot be read as a gesture, or an angle is out of its range.
    """
    path, said = Path(path), said or Said()
    if path.suffix.lower() == ".toml":
        return load_toml_gesture(path, fit, limits, said.longest_s)
    return load_motion(path, said).gesture(said, limits, fit)


def save_trajectory(trajectory: Trajectory, path: str | Path) -> list[str]:
    """Write a trajectory for other programs; the suffix says the format.

    Args:
        trajectory: what the robot should do.
        path: any of :data:`WRITERS`; replaced as a whole if it is there.

    Returns:
        What the format could not carry over, for people.

    Raises:
        GestureFileError: unknown suffix, or the place cannot be written.
    """
    return save_curves(curves_of(trajectory), path)


def save_curves(curves: Mapping[str, Curve], path: str | Path) -> list[str]:
    """Write the keys of some joints; see :func:`save_trajectory`."""
    path = Path(path)
    module = WRITERS.get(path.suffix.lower())
    if module is None:
        why = "is read, not written" if path.suffix.lower() in READERS else "unknown suffix"
        raise GestureFileError(path, f"{why} '{path.suffix}'; known: {', '.join(WRITERS)}")
    notes: list[str] = importlib.import_module(module).write(curves, path)
    return notes


def holds_a_motion(path: Path) -> bool:
    """Return whether a file with a known suffix is meant as a motion: many others are called ``.py`` or ``.json``."""
    suffix = path.suffix.lower()
    if suffix in (".motion", ".pos", ".xar", ".qianim", ".rrd"):
        return True
    if suffix == ".parquet":
        from nao_sim.gestures.formats.parquet_table import is_motion

        return is_motion(path)
    looks = _LOOKS.get(suffix)
    try:
        return looks is not None and looks(read_text(path))
    except GestureFileError:
        return False


def _table(text: str) -> bool:
    from nao_sim.gestures.formats.angle_table import is_table

    return is_table(text)


def _script(text: str) -> bool:
    from nao_sim.gestures.formats.naoqi_keys import is_motion

    return is_motion(text)


def _hulks(text: str) -> bool:
    from nao_sim.gestures.formats.hulks_json import is_motion

    try:
        return is_motion(json.loads(text))
    except (ValueError, RecursionError):
        return False


_LOOKS: dict[str, Callable[[str], bool]] = {
    ".csv": _table,
    ".tsv": _table,
    ".txt": _table,
    ".py": _script,
    ".json": _hulks,
    ".xml": lambda text: "<ActuatorCurve" in text,
    # A project's behaviours lie beside it and are found themselves.
    ".pml": lambda text: "<ActuatorCurve" in text,
    ".toml": lambda text: "[[key_frame]]" in text or "[walk]" in text,
}
