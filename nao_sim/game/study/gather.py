"""Sessions' folders, found below the places named, read into one set of tables."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from nao_sim.game.errors import GameError
from nao_sim.game.tables import Event, Rating, Session, Tables, Turn, is_folder_of_tables, read_tables
from nao_sim.game.tables.checks import check_tables
from nao_sim.game.tables.folder import changed_by_hand
from nao_sim.game.tables.instants import instant


@dataclass(frozen=True)
class Gathered:
    """Tables of many sessions, ordered by when they began.

    Attributes:
        tables: all rows.
        folders: the folder each session came from.
        notes: what a reader should know of the files, in words.
    """

    tables: Tables
    folders: dict[str, Path]
    notes: tuple[str, ...]


def gather(places: Sequence[Path]) -> Gathered:
    """Read every session in or below the places.

    Raises:
        GameError: a place does not exist or holds no session, a table is wrong, or two folders hold one session.
    """
    folders = list(dict.fromkeys(folder.resolve() for place in places for folder in _below(place)))
    sessions: list[Session] = []
    turns: list[Turn] = []
    ratings: list[Rating] = []
    events: list[Event] = []
    origin: dict[str, Path] = {}
    notes: list[str] = []
    for folder in folders:
        tables = read_tables(folder)
        for session in tables.sessions:
            if session.session in origin:
                raise GameError(
                    f"session {session.session!r} stands in {origin[session.session]} and in {folder}; name one of them"
                )
            origin[session.session] = folder
        sessions += tables.sessions
        turns += tables.turns
        ratings += tables.ratings
        events += tables.events
        notes += [
            f"{folder.name}/{name} was edited after it was written; this report goes by the Parquet file beside it"
            for name in changed_by_hand(folder, tables)
        ]
    sessions.sort(key=lambda s: (instant(s.started), s.session))
    rank = {s.session: i for i, s in enumerate(sessions)}
    turns.sort(key=lambda t: (rank[t.session], t.turn))
    gathered = Tables(tuple(sessions), tuple(turns), tuple(ratings), tuple(events))
    check_tables(gathered)
    return Gathered(gathered, origin, tuple(notes))


def _below(place: Path) -> list[Path]:
    if not place.exists():
        raise GameError(f"{place} does not exist; name the folder of a played session")
    if not place.is_dir():
        raise GameError(f"{place} is a file; name the folder of a played session")
    inside = [place, *sorted(p for p in place.rglob("*") if p.is_dir() and not p.name.startswith("."))]
    found = [folder for folder in inside if is_folder_of_tables(folder) and not (folder / "report.html").exists()]
    if not found:
        raise GameError(f"{place} holds no turns.parquet or turns.csv; name the folder of a played session")
    return found
