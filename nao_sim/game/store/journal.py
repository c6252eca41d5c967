"""A file that only grows: one checked line a record, on the disk before the next thing happens.

Each line is the CRC-32 of its text in eight hexadecimal digits, a blank, and the record as JSON. A kill can tear the
last line alone; it is then as if that record had never been written.
"""

from __future__ import annotations

import json
import os
import zlib
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from nao_sim.game.errors import GameError


def append(path: Path, record: dict[str, Any]) -> None:
    """Add a record and wait until the disk has it; a torn last line is taken off first.

    Raises:
        GameError: the journal is damaged before its last line.
        OSError: the disk is full or the file cannot be written.
    """
    whole = sum(len(line) for line in _whole_lines(path))
    text = json.dumps(record, ensure_ascii=False, allow_nan=False).encode()
    new = not path.exists()
    with path.open("ab") as file:
        file.truncate(whole)
        file.write(b"%08x %s\n" % (zlib.crc32(text), text))
        file.flush()
        os.fsync(file.fileno())
    if new:
        sync_folder(path.parent)


def read(path: Path) -> list[dict[str, Any]]:
    """Return all whole records, in order; none where there is no journal.

    Raises:
        GameError: the journal is damaged before its last line.
    """
    return [json.loads(line[9:]) for line in _whole_lines(path)]


def sync_folder(folder: Path) -> None:
    """Wait until the disk has the names in a folder."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _whole_lines(path: Path) -> Iterator[bytes]:
    lines = path.read_bytes().splitlines(keepends=True) if path.exists() else []
    for number, line in enumerate(lines, 1):
        if not _whole(line):
            if number < len(lines):
                raise GameError(f"{path}, line {number}, is damaged; restore the file from a copy")
            return
        yield line


def _whole(line: bytes) -> bool:
    try:
        return line.endswith(b"\n") and line[8:9] == b" " and int(line[:8], 16) == zlib.crc32(line[9:-1])
    except ValueError:
        return False
