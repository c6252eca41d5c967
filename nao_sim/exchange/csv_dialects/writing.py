"""Our tables in somebody's dialect."""

from __future__ import annotations

import csv
import io
from collections.abc import Sequence
from typing import Any

from nao_sim.exchange.csv_dialects.dialect import Dialect
from nao_sim.exchange.times import clock
from nao_sim.game.tables.column import Column
from nao_sim.game.tables.csv_text import MISSING, guard_text
from nao_sim.game.tables.schema import TableKind


def write_sheet(kind: TableKind, rows: Sequence[object], dialect: Dialect) -> bytes:
    """Return rows as CSV; texts in quotes, missing cells ``n/a``."""
    out = io.StringIO()
    writer = csv.writer(out, delimiter=dialect.delimiter, quoting=csv.QUOTE_NONNUMERIC, lineterminator="\n")
    writer.writerow([c.name for c in kind.columns])
    for row in rows:
        writer.writerow([_cell(c, getattr(row, c.name), dialect) for c in kind.columns])
    return out.getvalue().encode("utf-8-sig" if dialect.bom else "utf-8")


def _cell(c: Column, value: Any, dialect: Dialect) -> Any:
    if value is None:
        return MISSING
    if c.kind == "yes/no":
        return "yes" if value else "no"
    if c.kind == "list":
        return guard_text("|".join(value))
    if c.kind == "whole":
        return value
    if c.kind == "number":
        if dialect.clock and c.unit == "s" and value >= 0:
            return clock(value)
        return value if dialect.decimal == "." else str(value).replace(".", ",")
    return guard_text(value)
