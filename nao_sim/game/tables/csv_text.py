"""A table as CSV that spreadsheets, R and pandas read without changing a value.

UTF-8, commas, decimal points, texts in quotes, missing cells ``n/a``, lists joined by ``|``, yes/no. A text that a
spreadsheet would run as a formula gets an apostrophe in front, which reading takes away again.
"""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

from nao_sim.game.errors import GameError
from nao_sim.game.tables.column import Column
from nao_sim.game.tables.parquet import check_names, check_stamp
from nao_sim.game.tables.schema import Row, TableKind

MISSING = "n/a"
_FORMULA = ("=", "+", "-", "@", "\t", "\r", "'")


def guard_text(text: str) -> str:
    """Put an apostrophe before what a spreadsheet would run, or what reads as missing."""
    return f"'{text}" if text.startswith(_FORMULA) or text == MISSING else text


def unguard_text(text: str) -> str:
    """Undo ``guard_text``."""
    rest = text[1:]
    return rest if text.startswith("'") and (rest.startswith(_FORMULA) or rest == MISSING) else text


def to_csv(kind: TableKind, rows: Sequence[object], derived: Sequence[dict[str, Any]] = ()) -> str:
    """Return rows as text, beside each its derived cells if the kind has any."""
    out = io.StringIO()
    columns = kind.columns + kind.derived
    out.write(",".join(_quoted(name) for name in ["schema", *(c.name for c in columns)]) + "\n")
    for i, row in enumerate(rows):
        values = [getattr(row, c.name) for c in kind.columns] + [derived[i][c.name] for c in kind.derived]
        cells = [_cell(c, v) for c, v in zip(columns, values, strict=True)]
        out.write(",".join([_quoted(kind.stamp), *cells]) + "\n")
    return out.getvalue()


def _quoted(text: str) -> str:
    return '"' + text.replace('"', '""') + '"'


def _cell(c: Column, value: Any) -> str:
    if value is None:
        return MISSING
    if c.kind == "yes/no":
        return "yes" if value else "no"
    if c.kind == "number":
        return repr(float(value))
    if c.kind == "whole":
        return str(int(value))
    return _quoted(guard_text("|".join(value) if c.kind == "list" else value))


def from_csv(where: str, text: str, kind: TableKind) -> list[Row]:
    """Read what ``to_csv`` wrote; other people's dialects are the business of ``nao_sim.exchange``.

    Args:
        where: the file's name, for errors.
        text: its text.
        kind: which table it is.

    Raises:
        GameError: naming the line and column of the first bad cell.
    """
    lines = csv.reader(io.StringIO(text.removeprefix("\ufeff"), newline=""))
    names = next(lines, [])
    check_names(where, names, kind)
    columns = {c.name: c for c in kind.columns}
    rows: list[Row] = []
    for cells in lines:
        if len(cells) != len(names):
            raise GameError(f"{where} line {lines.line_num}: {len(cells)} cells under {len(names)} columns")
        row = dict(zip(names, cells, strict=True))
        check_stamp(f"{where} line {lines.line_num}", row.get("schema", ""), kind)
        values = {n: _value(f"{where} line {lines.line_num}", columns[n], v) for n, v in row.items() if n in columns}
        rows.append(kind.row(**values))
    return rows


def _value(where: str, c: Column, text: str) -> Any:
    if text == MISSING and (c.optional or c.kind != "text"):
        if c.optional:
            return None
        raise GameError(f"{where}: {c.name} must not be missing")
    try:
        if c.kind == "yes/no":
            return {"yes": True, "no": False}[text]
        if c.kind == "number":
            return float(text)
        if c.kind == "whole":
            return int(text)
    except (ValueError, KeyError):
        raise GameError(f"{where}: {c.name} is {text!r}, not a {c.kind}") from None
    plain = unguard_text(text)
    return tuple(plain.split("|")) if c.kind == "list" and plain else () if c.kind == "list" else plain
