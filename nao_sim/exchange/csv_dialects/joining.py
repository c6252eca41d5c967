"""Rows that were read join the tables of a folder; what is there stays."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import fields, replace
from typing import Any

from nao_sim.exchange.csv_dialects.reading import Sheet
from nao_sim.exchange.csv_dialects.rows import rows_from
from nao_sim.exchange.errors import ExchangeError
from nao_sim.game.tables import Rating, Session, Tables, Turn
from nao_sim.game.tables.schema import Row, kind_of


def join_sheet(
    tables: Tables,
    name: str,
    sheet: Sheet,
    mapping: Mapping[str, str],
    constants: Mapping[str, str],
    milliseconds: bool = False,
) -> tuple[Tables, int]:
    """Add a sheet's rows to a table; return the tables and how many rows were new.

    Turns of a session that is not there yet bring one: its circle is who models and imitates in them, everything else
    comes from ``constants``, which may name columns of ``sessions`` as well.

    Args:
        tables: what is there.
        name: which table.
        sheet: the file.
        mapping: our columns to the file's.
        constants: our columns to a text for every row.
        milliseconds: whether plain times are milliseconds.

    Raises:
        ExchangeError: a row has the key of one that is there and says something else, or as ``rows_from``.
    """
    kind = kind_of(name)
    ours = {c.name for c in kind.columns}
    of_sessions = {c.name for c in kind_of("sessions").columns}
    own = {k: v for k, v in constants.items() if k in ours or name != "turns" or k not in of_sessions}
    rows = rows_from(sheet, kind, mapping, own, milliseconds)
    if name == "turns":
        tables = _with_sessions(tables, sheet, [r for r in rows if isinstance(r, Turn)], constants)
    there: tuple[Row, ...] = getattr(tables, name)
    known = {_key(row): row for row in there}
    new = []
    for (line, _), row in zip(sheet.rows, rows, strict=True):
        old = known.get(_key(row))
        if old is not None and old != row:
            raise ExchangeError(
                f"{sheet.where} line {line}: {_key(row)} is there already and says something else: {_differ(old, row)}"
            )
        if old is None:
            known[_key(row)] = row
            new.append(row)
    changes: dict[str, Any] = {name: (*there, *new)}
    return replace(tables, **changes), len(new)


def _key(row: Row) -> object:
    if isinstance(row, Turn):
        return row.turn_id
    if isinstance(row, Rating):
        return (row.turn_id, row.rater, row.when)
    return row.session if isinstance(row, Session) else row


def _differ(old: Row, new: Row) -> str:
    names = [f.name for f in fields(old) if getattr(old, f.name) != getattr(new, f.name)]
    return ", ".join(f"{n} {getattr(old, n)!r} and {getattr(new, n)!r}" for n in names[:3])


def _with_sessions(tables: Tables, sheet: Sheet, turns: Sequence[Turn], constants: Mapping[str, str]) -> Tables:
    known = {s.session for s in tables.sessions}
    kind = kind_of("sessions")
    names = [c.name for c in kind.columns]
    added: list[Row] = []
    for session in dict.fromkeys(t.session for t in turns if t.session not in known):
        mine = [t for t in turns if t.session == session]
        seats = dict.fromkeys(
            seat for t in mine for seat in (f"{t.model_role}:{t.model}", f"{t.imitator_role}:{t.imitator}")
        )
        values = {k: v for k, v in constants.items() if k in names}
        values |= {"session": session, "condition": mine[0].condition, "design": mine[0].design}
        values.setdefault("circle", "|".join(seats))
        one = replace(sheet, columns=(), rows=((sheet.rows[0][0], ()),))
        added += rows_from(one, kind, {}, values)
    return replace(tables, sessions=(*tables.sessions, *(row for row in added if isinstance(row, Session))))
