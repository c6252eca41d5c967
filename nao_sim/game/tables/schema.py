"""Names and versions of the tables, and their Arrow schemas."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from nao_sim.game.tables.column import Column, columns_of
from nao_sim.game.tables.event import Event
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.session import Session
from nao_sim.game.tables.turn import Turn

if TYPE_CHECKING:
    import pyarrow as pa

Row = Session | Turn | Rating | Event
"""What the four tables of a session hold."""

VERSION = 1
"""Grows when a column changes its meaning or leaves; a new optional column does not change it."""

TABLES: dict[str, type] = {"sessions": Session, "turns": Turn, "ratings": Rating, "events": Event}

DERIVED = (
    Column("score", "whole", True, "the score that is reported: a person's, else the proposal", "", ()),
    Column("score_by", "text", True, "whose it is: a rater's pseudonym, or auto", "", ()),
    Column("confirmed", "yes/no", False, "whether a person has rated the turn", "", ()),
)
"""Columns that end the stored ``turns``: computed from ``ratings`` at each writing, ignored at reading."""


@dataclass(frozen=True)
class TableKind:
    """What a table is called, which rows it holds, and its columns."""

    name: str
    row: type
    columns: tuple[Column, ...]
    derived: tuple[Column, ...]

    @property
    def stamp(self) -> str:
        """What every stored table carries in its column ``schema``, e.g. ``turns/1``."""
        return f"{self.name}/{VERSION}"


@cache
def kind_of(name: str) -> TableKind:
    """Return the kind of table of a name of ``TABLES``."""
    row = TABLES[name]
    return TableKind(name, row, columns_of(row), DERIVED if name == "turns" else ())


def arrow_schema(kind: TableKind) -> pa.Schema:
    """Return the Arrow schema of a stored table; units and meanings stand in the fields' metadata."""
    import pyarrow as pa

    types = {
        "text": pa.string(),
        "whole": pa.int64(),
        "number": pa.float64(),
        "yes/no": pa.bool_(),
        "list": pa.list_(pa.string()),
    }
    fields = [pa.field("schema", pa.string(), nullable=False)]
    for c in kind.columns + kind.derived:
        about = (
            {"doc": c.doc} | ({"unit": c.unit} if c.unit else {}) | ({"words": " ".join(c.words)} if c.words else {})
        )
        fields.append(pa.field(c.name, types[c.kind], nullable=c.optional, metadata=about))
    return pa.schema(fields, metadata={"nao_sim.schema": kind.stamp})
