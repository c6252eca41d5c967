"""Files that are either whole or not there."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from nao_sim.errors import NaoSimError


class FileError(NaoSimError):
    """A file that cannot be written."""


@contextmanager
def whole_file(path: Path, suffix: str = "") -> Iterator[Path]:
    """Give a hidden place beside a file to write to; it takes the file's name when the block ends without an error.

    Args:
        path: the file.
        suffix: of the hidden place, where the file has none and the writer goes by it.

    Raises:
        FileError: the place cannot be written, or the disk is full.
    """
    beside = path.with_name(f".{path.stem}.part{path.suffix or suffix}")
    try:
        yield beside
        os.replace(beside, path)
    except OSError as error:
        raise FileError(f"{path} cannot be written ({error.strerror or error}); choose another place") from None
    finally:
        beside.unlink(missing_ok=True)
