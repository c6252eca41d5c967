"""The manifest of a data set: which clip shows whom performing what.

A row has at least ``file`` (relative to the data set's folder), ``label``, ``person``, ``fps``, ``frames``, ``width``,
``height``, and ``start`` and ``end``, the first and the last frame that belong to it.
"""

from __future__ import annotations

import csv
import os
import tomllib
from collections.abc import Callable, Sequence
from functools import lru_cache
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq

from nao_sim.people.errors import FilmError
from nao_sim.people.performance.motions import IRRELEVANT
from nao_sim.resources import resource

NEEDED = ("file", "label", "person")
_WHOLE = ("frames", "width", "height", "start", "end", "take")


@lru_cache
def known_labels() -> dict[str, str]:
    """Label -> family, for every class of the vocabulary, and ``irrelevant``."""
    with resource("assets", "vocabulary.toml").open("rb") as file:
        rows = tomllib.load(file)["gesture"]
    return {row["name"]: row["family"] for row in rows} | {IRRELEVANT: "none"}


def write_manifest(out: Path, rows: Sequence[dict[str, Any]]) -> None:
    """Write ``manifest.parquet`` and ``manifest.csv`` of ``rows`` into ``out``, atomically."""
    table = pa.Table.from_pylist(list(rows))
    replace_file(out / "manifest.parquet", lambda part: pq.write_table(table, part))

    def as_csv(part: Path) -> None:
        with part.open("w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, fieldnames=table.column_names)
            writer.writeheader()
            writer.writerows(rows)

    replace_file(out / "manifest.csv", as_csv)


def read_manifest(folder: Path) -> list[dict[str, Any]]:
    """Read the rows of a data set's manifest.

    Raises:
        FilmError: there is none, or it lacks a column.
    """
    parquet, text = folder / "manifest.parquet", folder / "manifest.csv"
    if parquet.is_file():
        try:
            rows = pq.read_table(parquet).to_pylist()
        except pa.ArrowException as error:
            raise FilmError(f"{parquet} is not a Parquet file; delete it to use manifest.csv: {error}") from error
    elif text.is_file():
        rows = read_table(text)
    else:
        raise FilmError(f"{folder} has no manifest.parquet or manifest.csv; 'nao-sim dataset import' makes one")
    missing = [name for name in NEEDED if rows and name not in rows[0]]
    if missing or not rows:
        raise FilmError(
            f"the manifest of {folder} has no column '{missing[0]}'" if missing else f"{folder} has no clips"
        )
    return rows


def read_table(path: Path) -> list[dict[str, Any]]:
    """Read a CSV table with a header line; frame numbers and sizes become integers.

    Raises:
        FilmError: a number is none.
    """
    try:
        with path.open(newline="", encoding="utf-8-sig") as file:
            rows: list[dict[str, Any]] = [dict(row) for row in csv.DictReader(file)]
        for row in rows:
            row |= {name: int(float(row[name])) for name in _WHOLE if row.get(name)}
    except (UnicodeDecodeError, ValueError, csv.Error) as error:
        raise FilmError(f"{path} is not a table of clips: {error}") from error
    return rows


def replace_file(path: Path, write: Callable[[Path], Any]) -> None:
    """Let ``write`` fill a file beside ``path`` and put it in place, so that nothing half-written is ever read."""
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        write(part)
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
