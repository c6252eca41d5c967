"""What must hold in the tables of a study; each fault is one line that names the row."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING, Any

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError
from nao_sim.game.tables.column import Column
from nao_sim.game.tables.instants import instant
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.schema import Row, kind_of
from nao_sim.game.tables.scores import AUTO
from nao_sim.game.tables.session import Session
from nao_sim.game.tables.turn import Turn
from nao_sim.game.tables.words import PROMPT_LEVELS, ROLES

if TYPE_CHECKING:
    from nao_sim.game.tables.folder import Tables

_TYPES: dict[str, tuple[type, ...]] = {
    "text": (str,), "whole": (int,), "number": (int, float), "yes/no": (bool,), "list": (tuple,),
}  # fmt: skip
_SAME_TIME_S = 0.0015
"""Two ways to say a time may differ by rounding to milliseconds."""


def check_tables(tables: Tables) -> None:
    """Check every cell, and that the tables belong together.

    Raises:
        GameError: the first fault.
    """
    for fault in faults(tables):
        raise GameError(fault)


def faults(tables: Tables) -> Iterator[str]:
    """Yield every fault of the tables."""
    for name in ("sessions", "turns", "ratings", "events"):
        rows: tuple[Row, ...] = getattr(tables, name)
        for number, row in enumerate(rows, 1):
            where = f"{name} row {number} ({_key(row)})"
            cells = list(_cell_faults(name, row))
            yield from (f"{where}: {fault}" for fault in cells)
            if not cells:
                yield from (f"{where}: {fault}" for fault in _row_faults(row))
    yield from _twice("sessions", (s.session for s in tables.sessions))
    yield from _twice("turns", (t.turn_id for t in tables.turns))
    yield from _twice("turns", (f"{t.session} turn {t.turn}" for t in tables.turns))
    yield from _strangers(tables)


def _key(row: Row) -> str:
    return row.turn_id if isinstance(row, Turn | Rating) else row.session


def _cell_faults(table: str, row: Row) -> Iterator[str]:
    for c in kind_of(table).columns:
        value = getattr(row, c.name)
        if value is None:
            if not c.optional:
                yield f"{c.name} must not be missing"
        elif not _fits(c, value):
            yield f"{c.name} is {value!r}, not a {c.kind}"
        elif c.words and value not in c.words:
            yield f"{c.name} is {value!r}{did_you_mean(str(value), c.words)}"


def _fits(c: Column, value: Any) -> bool:
    if isinstance(value, bool) != (c.kind == "yes/no") or not isinstance(value, _TYPES[c.kind]):
        return False
    if isinstance(value, tuple):
        return all(isinstance(item, str) and item and "|" not in item for item in value)
    return math.isfinite(value) if isinstance(value, float) else not isinstance(value, int) or abs(value) < 2**63


def _row_faults(row: Row) -> Iterator[str]:
    if isinstance(row, Session):
        yield from _session_faults(row)
    elif isinstance(row, Turn):
        yield from _turn_faults(row)
    elif isinstance(row, Rating):
        yield from _instant_faults("when", row.when)
        yield from _score_faults("score", row.score, row.scale)
        if row.rater == AUTO:
            yield f"a rater may not be called {AUTO!r}"
        if row.score is not None and row.excluded is not None:
            yield "score and excluded are both given; a turn that is no trial has no score"


def _session_faults(row: Session) -> Iterator[str]:
    yield from _instant_faults("started", row.started)
    yield from _score_faults("success_at", row.success_at, row.scale)
    if row.success_at == 0:
        yield "success_at is 0, so that every turn would be a success; give 1 or more"
    if row.margin is not None and not 0 < row.margin <= 1:
        yield f"margin is {row.margin}, not a share above 0 and up to 1"
    for seat in row.circle:
        role, colon, name = seat.partition(":")
        if not colon or not name or role not in ROLES:
            yield f"circle holds {seat!r}, not role:pseudonym with a role of {', '.join(ROLES)}"


def _turn_faults(row: Turn) -> Iterator[str]:
    yield from _score_faults("auto_score", row.auto_score, row.auto_scale or "0/1/2")
    if row.prompt_level is not None and row.prompt_level not in PROMPT_LEVELS:
        yield f"prompt_level is {row.prompt_level}, not 0 to 4"
    if row.auto_score is not None and (row.auto_rule is None or row.auto_scale is None):
        yield "auto_score needs auto_rule and auto_scale"
    for first, then in (("model_start_s", "model_end_s"), ("movement_start_s", "movement_end_s")):
        start, end = getattr(row, first), getattr(row, then)
        if start is not None and end is not None and end < start:
            yield f"{then} {end} lies before {first} {start}"
    if row.latency_censored and (row.latency_s is not None or row.waited_s is None):
        yield "a censored latency has waited_s and no latency_s"
    if row.latency_s is not None and row.model_end_s is not None and row.movement_start_s is not None:
        measured = row.movement_start_s - row.model_end_s
        if abs(measured - row.latency_s) > _SAME_TIME_S:
            yield f"latency_s is {row.latency_s}, movement_start_s - model_end_s is {measured:.3f}"


def _instant_faults(name: str, text: str) -> Iterator[str]:
    try:
        instant(text)
    except ValueError:
        yield f"{name} is {text!r}, not ISO 8601 with a zone such as 2027-03-01T10:00:00+01:00"


def _score_faults(name: str, score: int | None, scale: str) -> Iterator[str]:
    if score is not None and str(score) not in scale.split("/"):
        yield f"{name} is {score}, not one of {scale}"


def _twice(table: str, keys: Iterable[str]) -> Iterator[str]:
    seen: set[str] = set()
    for key in keys:
        if key in seen:
            yield f"{table}: {key} stands there twice"
        seen.add(key)


def _strangers(tables: Tables) -> Iterator[str]:
    sessions = {s.session: s for s in tables.sessions}
    turns = {t.turn_id for t in tables.turns}
    for t in tables.turns:
        s = sessions.get(t.session)
        if s is None:
            yield f"turns: {t.turn_id} belongs to the session {t.session!r}, which sessions does not hold"
        elif (t.condition, t.design) != (s.condition, s.design):
            yield f"turns: {t.turn_id} says {t.condition}, {t.design}; its session says {s.condition}, {s.design}"
    for r in tables.ratings:
        if r.turn_id not in turns:
            yield f"ratings: {r.rater} rated {r.turn_id!r}, which turns does not hold"
    for e in tables.events:
        if e.session not in sessions or (e.turn_id is not None and e.turn_id not in turns):
            yield f"events: {e.kind} at {e.start_s} s belongs to {e.turn_id or e.session!r}, which is not there"
