"""What the text formats share: lines read with a bound, files replaced as a whole."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from nao_sim.gestures.errors import GestureFileError

MAX_BYTES = 64_000_000


def read_text(path: Path, most_bytes: int = MAX_BYTES) -> str:
    """Return a text file, a byte order mark left out.

    Raises:
        GestureFileError: missing, a folder, too large, or not UTF-8 text.
    """
    check_file(path, most_bytes)
    try:
        return path.read_text(encoding="utf-8-sig")
    except UnicodeDecodeError as error:
        raise GestureFileError(path, f"is not UTF-8 text (byte {error.start}); save it as UTF-8") from error


def check_file(path: Path, most_bytes: int = MAX_BYTES) -> None:
    """Refuse what is no file, or too large to be a motion."""
    if not path.is_file():
        raise GestureFileError(path, "is a folder, not a motion file" if path.is_dir() else "no such motion file")
    if path.stat().st_size > most_bytes:
        raise GestureFileError(path, f"is larger than {most_bytes // 1_000_000} MB; split the motion")


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
