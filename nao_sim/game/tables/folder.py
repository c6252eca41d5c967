"""The four tables in a folder, each as Parquet (what is read) and as CSV (what people open)."""

from __future__ import annotations

import os
import tempfile
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from nao_sim.game.errors import GameError
from nao_sim.game.tables.checks import check_tables
from nao_sim.game.tables.csv_text import from_csv, to_csv
from nao_sim.game.tables.event import Event
from nao_sim.game.tables.parquet import from_parquet, to_parquet
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.schema import TABLES, Row, kind_of
from nao_sim.game.tables.scores import accept, latest_ratings
from nao_sim.game.tables.session import Session
from nao_sim.game.tables.turn import Turn


@dataclass(frozen=True)
class Tables:
    """The rows of one session, or of many."""

    sessions: tuple[Session, ...]
    turns: tuple[Turn, ...]
    ratings: tuple[Rating, ...] = ()
    events: tuple[Event, ...] = ()


def is_folder_of_tables(folder: Path) -> bool:
    """Whether a folder holds a session's tables."""
    return any((folder / f"turns{ending}").is_file() for ending in (".parquet", ".csv"))


def read_tables(folder: Path) -> Tables:
    """Read the tables of a folder: Parquet where it is, else CSV; ratings and events may be absent.

    Raises:
        GameError: a table is missing or wrong.
    """
    rows = {name: tuple(_read(folder, name)) for name in TABLES}
    tables = Tables(**rows)  # type: ignore[arg-type]
    try:
        check_tables(tables)
    except GameError as error:
        raise GameError(f"{folder}: {error}") from None
    return tables


def _read(folder: Path, name: str) -> list[Row]:
    kind = kind_of(name)
    parquet, text = folder / f"{name}.parquet", folder / f"{name}.csv"
    if parquet.is_file():
        return from_parquet(parquet, kind)
    if text.is_file():
        try:
            return from_csv(str(text), text.read_bytes().decode("utf-8"), kind)
        except UnicodeDecodeError as error:
            raise GameError(f"{text} is not UTF-8 (byte {error.start}); save it as UTF-8") from None
    if name in ("sessions", "turns"):
        raise GameError(f"{folder} holds no {name}.parquet and no {name}.csv; name the folder of a played session")
    return []


def write_tables(folder: Path, tables: Tables) -> None:
    """Write the tables into a folder; each file is replaced whole or not at all.

    Args:
        folder: made if it is missing.
        tables: checked first.

    Raises:
        GameError: the tables are wrong.
        OSError: the folder cannot be written.
    """
    check_tables(tables)
    folder.mkdir(parents=True, exist_ok=True)
    for name in TABLES:
        kind, rows = kind_of(name), getattr(tables, name)
        derived = _derived(tables) if kind.derived else []
        _replace(folder / f"{name}.csv", to_csv(kind, rows, derived).encode())
        _replace(folder / f"{name}.parquet", to_parquet(kind, rows, derived))  # last: it is what reading trusts


def _replace(path: Path, content: bytes) -> None:
    handle, name = tempfile.mkstemp(prefix=f".{path.name}-", dir=path.parent)
    try:
        with os.fdopen(handle, "wb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(name, 0o644)
        os.replace(name, path)
    except BaseException:
        os.unlink(name)
        raise


def _derived(tables: Tables) -> list[dict[str, Any]]:
    ratings = latest_ratings(tables.ratings)
    primary = {s.session: s.primary_rater for s in tables.sessions}
    found = []
    for turn in tables.turns:
        a = accept(turn, ratings.get(turn.turn_id, {}), primary[turn.session])
        found.append({"score": a.score, "score_by": a.by, "confirmed": a.confirmed})
    return found


def changed_by_hand(folder: Path, tables: Tables) -> list[str]:
    """Return the CSV files of a folder whose text is not that of the tables read from its Parquet files."""
    changed = []
    for name in TABLES:
        text = folder / f"{name}.csv"
        if not text.is_file() or not (folder / f"{name}.parquet").is_file():
            continue
        kind = kind_of(name)
        if text.read_bytes() != to_csv(kind, getattr(tables, name), _derived(tables) if kind.derived else []).encode():
            changed.append(text.name)
    return changed
