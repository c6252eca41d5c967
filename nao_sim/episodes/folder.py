"""A folder that is either complete or not there."""

from __future__ import annotations

import errno
import os
import re
import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from nao_sim.episodes.errors import EpisodeError
from nao_sim.processes import alive

_FORMER = "former"
_MEND = {
    errno.ENOSPC: "free some space or choose another place with --out",
    errno.EDQUOT: "free some space or choose another place with --out",
    errno.EACCES: "choose a folder you may write to with --out",
    errno.EPERM: "choose a folder you may write to with --out",
    errno.EROFS: "choose a folder you may write to with --out",
}


def _error(folder: Path, error: OSError) -> EpisodeError:
    mend = _MEND.get(error.errno or 0, "choose another place with --out")
    return EpisodeError(f"{folder} cannot be written ({error.strerror or error}); {mend}")


def _refuse_to_overwrite(folder: Path, marker: str) -> None:
    """Only a folder that we made (it holds ``marker``) or an empty one may be replaced."""
    if folder.exists() and not folder.is_dir():
        raise EpisodeError(f"{folder} is a file; choose a folder with --out")
    if folder.is_dir() and any(folder.iterdir()) and not (folder / marker).exists():
        raise EpisodeError(f"{folder} holds other files; choose a new or empty folder with --out")


def check_place(folder: Path, marker: str = "episode.json") -> None:
    """Say before the work is done that its result could not be kept.

    Raises:
        EpisodeError: the place holds something else or cannot be written.
    """
    with _errors_named(folder):
        _refuse_to_overwrite(folder, marker)
        parent = next(p for p in folder.absolute().parents if p.exists())
        with tempfile.TemporaryFile(dir=parent):
            pass


@contextmanager
def _errors_named(folder: Path) -> Iterator[None]:
    try:
        yield
    except OSError as error:
        raise _error(folder, error) from None


@contextmanager
def complete_folder(folder: Path, marker: str) -> Iterator[Path]:
    """Give a hidden folder to fill; it takes its name only when the block ends without an error.

    Args:
        folder: where the result shall stand. Missing parents are made.
        marker: the file by which an older result is known; such a folder is replaced.

    Yields:
        The folder to write into, on the same file system.

    Raises:
        EpisodeError: the place holds something else or cannot be written.
    """
    folder = folder.absolute()
    with _errors_named(folder):
        _refuse_to_overwrite(folder, marker)
        folder.parent.mkdir(parents=True, exist_ok=True)
        _sweep(folder)
        work = Path(tempfile.mkdtemp(prefix=_beside(folder), dir=folder.parent))
        try:
            yield work
            work.chmod(0o777 & ~_umask())
            _replace(folder, work)
        finally:
            shutil.rmtree(work, ignore_errors=True)


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


def _beside(folder: Path) -> str:
    """Return how the hidden folders of this process beside a result are called, up to what makes each unique."""
    return f".{folder.name}-{os.getpid()}-"


def _sweep(folder: Path) -> None:
    """Remove what runs that were killed have left beside a result, and put back one that was being replaced."""
    left = re.compile(re.escape(f".{folder.name}-") + r"(\d+)-\w{8}")
    for path in list(folder.parent.iterdir()):
        match = left.fullmatch(path.name)
        if match is None or not path.is_dir() or alive(int(match[1])):
            continue
        former = path / _FORMER
        if former.is_dir() and not folder.exists():
            former.rename(folder)
        shutil.rmtree(path, ignore_errors=True)


def _replace(folder: Path, work: Path) -> None:
    if not folder.exists():
        work.rename(folder)
        return
    old = Path(tempfile.mkdtemp(prefix=_beside(folder), dir=folder.parent))
    folder.rename(old / _FORMER)
    work.rename(folder)
    shutil.rmtree(old, ignore_errors=True)
