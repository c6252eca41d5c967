"""What the formats share: dense samples as a gesture, and files replaced as a whole."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import KeyFrame

_MAX_BYTES = 64_000_000


def read_lines(path: Path) -> list[str]:
    """Return the lines of a text file.

    Raises:
        GestureFileError: missing, a folder, too large, or not UTF-8 text.
    """
    if not path.is_file():
        what = "is a folder, not a motion file" if path.is_dir() else "no such motion file"
        raise GestureFileError(path, what)
    if path.stat().st_size > _MAX_BYTES:
        raise GestureFileError(path, f"is larger than {_MAX_BYTES // 1_000_000} MB; split the motion")
    try:
        return path.read_text(encoding="utf-8-sig").splitlines()
    except UnicodeDecodeError as error:
        raise GestureFileError(path, f"is not UTF-8 text (byte {error.start}); save it as UTF-8") from error


def gesture_of_samples(
    path: Path, names: list[str], times: list[float], rows: NDArray[np.float64], fit: bool
) -> Gesture:
    """Return samples as a gesture; a NaN means that the joint passes through.

    Args:
        path: where they came from; its stem is the gesture's name.
        names: NAOqi joint names, already checked, length k.
        times: seconds, length n.
        rows: rad (hands fraction), shape (n, k).
        fit: leave angles outside their range for fitting to clip.

    Raises:
        GestureFileError: no samples, times out of order, or an angle outside its range.
    """
    if not times:
        raise GestureFileError(path, "has no samples")
    checks.increasing(times, path)
    frames = []
    for time_s, row in zip(times, rows, strict=True):
        angles = {name: float(value) for name, value in zip(names, row, strict=True) if np.isfinite(value)}
        if not fit:
            checks.inside_range(angles, time_s, path)
        frames.append(KeyFrame(time_s, angles))
    return Gesture(path.stem, None, "own", "linear", "none", path.stem, f"{path.stem}_mirrored", tuple(frames), "cubic")


def write_whole(path: Path, text: str) -> None:
    """Write a text file beside its place and move it there, so that nobody sees half of it.

    Raises:
        GestureFileError: the place cannot be written.
    """
    try:
        _write_whole(path, text)
    except OSError as error:
        raise GestureFileError(path, f"cannot be written ({error.strerror or error}); choose another place") from None


def _write_whole(path: Path, text: str) -> None:
    descriptor, beside = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    try:
        with os.fdopen(descriptor, "w", encoding="utf-8", newline="\n") as out:
            out.write(text)
        os.chmod(beside, 0o644)
        os.replace(beside, path)
    except BaseException:
        Path(beside).unlink(missing_ok=True)
        raise
