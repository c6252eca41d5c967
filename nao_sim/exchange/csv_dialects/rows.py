"""Other people's columns as rows of our tables."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.exchange.csv_dialects.reading import Sheet
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.times import number_of, seconds_of
from nao_sim.game.tables.column import Column
from nao_sim.game.tables.schema import Row, TableKind

MISSING = ("", "n/a", "NA", "N/A", "NaN", "nan", "null", "NULL", ".")
"""What stands for a missing number; in a text only the empty cell and n/a do, since NA may be somebody's id."""

_YES = dict.fromkeys(("yes", "y", "true", "1", "ja"), True) | dict.fromkeys(("no", "n", "false", "0", "nein"), False)


def rows_from(
    sheet: Sheet, kind: TableKind, mapping: Mapping[str, str], constants: Mapping[str, str], milliseconds: bool = False
) -> list[Row]:
    """Return a sheet's lines as rows of a table.

    Columns are found by our name, upper and lower case alike, or as ``mapping`` says; columns that are neither are left
    out. A turn without a number is numbered by its line, and without a key gets ``session/number``.

    Args:
        sheet: the file.
        kind: the table.
        mapping: our name to the file's.
        constants: our name to a text that every row gets.
        milliseconds: whether plain times are milliseconds.

    Raises:
        ExchangeError: a column that is needed is not there, or a cell is not what its column holds.
    """
    places = _places(sheet, kind, mapping)
    columns = {c.name: c for c in kind.columns}
    for name in constants:
        if name not in columns:
            raise ExchangeError(f"{kind.name} has no column {name!r}{did_you_mean(name, columns)}")
    rows: list[Row] = []
    numbers: dict[str, int] = {}
    for line, cells in sheet.rows:
        texts = dict(constants) | {name: cells[i] for name, i in places.items()}
        if kind.name == "turns":
            number = numbers.get(texts.get("session", ""), 0) + 1
            numbers[texts.get("session", "")] = number
            texts.setdefault("turn", str(number))
            texts.setdefault("turn_id", f"{texts.get('session', '')}/{int(number_of(texts['turn'])):03}")
        values = {}
        for name, text in texts.items():
            value = _value(f"{sheet.where} line {line}", columns[name], text, sheet.dialect.decimal, milliseconds)
            if value is not None or columns[name].optional:
                values[name] = value
        rows.append(kind.row(**_complete(sheet, line, kind, values)))
    return rows


def _places(sheet: Sheet, kind: TableKind, mapping: Mapping[str, str]) -> dict[str, int]:
    ours = {c.name for c in kind.columns}
    by_name = {name.casefold(): i for i, name in enumerate(sheet.columns)}
    for name, theirs in mapping.items():
        if name not in ours:
            raise ExchangeError(f"{kind.name} has no column {name!r}{did_you_mean(name, sorted(ours))}")
        if theirs.casefold() not in by_name:
            raise ExchangeError(f"{sheet.where} has no column {theirs!r}{did_you_mean(theirs, sheet.columns)}")
    found = {name: by_name[name] for name in ours if name in by_name}
    return found | {name: by_name[theirs.casefold()] for name, theirs in mapping.items()}


def _complete(sheet: Sheet, line: int, kind: TableKind, values: dict[str, Any]) -> dict[str, Any]:
    for f in dataclasses.fields(kind.row):
        if f.default is dataclasses.MISSING and f.name not in values:
            raise ExchangeError(
                f"{sheet.where} line {line}: no {f.name!r} ({f.metadata['doc']}); "
                f"say --columns {f.name}=THEIR_COLUMN or --set {f.name}=VALUE"
            )
    return values


def _value(where: str, c: Column, text: str, decimal: str, milliseconds: bool) -> Any:
    bare = text.strip()
    if bare in (("", "n/a") if c.kind in ("text", "list") else MISSING):
        return None if c.optional or c.kind not in ("text", "list") else "" if c.kind == "text" else ()
    try:
        if c.kind == "text":
            return bare if c.words else text
        if c.kind == "list":
            return tuple(part.strip() for part in text.split("|") if part.strip())
        if c.kind == "yes/no":
            return _YES[bare.lower()]
        if c.kind == "whole":
            return _whole(bare, decimal)
        if c.unit == "s":
            return seconds_of(bare, decimal) / (1000 if milliseconds and ":" not in bare else 1)
        return number_of(bare, decimal)
    except (ValueError, KeyError):
        hint = " (decimal comma? say --decimal ,)" if "," in bare and decimal == "." else ""
        raise ExchangeError(f"{where}: {c.name} is {text!r}, not a {c.kind}{hint}") from None


def _whole(text: str, decimal: str) -> int:
    """Return a whole number; 1.0 is one, since a column with a gap comes back so from other tools."""
    value = number_of(text, decimal)
    if value != int(value):
        raise ValueError(text)
    return int(value)
