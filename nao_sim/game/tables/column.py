"""One column of a table: its type, unit, words and meaning, kept with the dataclass field it describes."""

from __future__ import annotations

import dataclasses
import types
import typing
from dataclasses import dataclass, field
from typing import Any

Kind = typing.Literal["text", "whole", "number", "yes/no", "list"]


@dataclass(frozen=True)
class Column:
    """A column as a reader of the table needs it.

    Attributes:
        name: its name, the same in Parquet, in CSV and in the dataclass.
        kind: text, whole (64-bit integer), number (64-bit float), yes/no, or list (of text).
        optional: whether a cell may be missing (null in Parquet, ``n/a`` in CSV).
        doc: what it says.
        unit: of a number; empty for none.
        words: the values it may take; empty where any is allowed.
    """

    name: str
    kind: Kind
    optional: bool
    doc: str
    unit: str
    words: tuple[str, ...]


def column(doc: str, *, unit: str = "", words: tuple[str, ...] = (), **default: Any) -> Any:
    """Declare a dataclass field that is a column; ``default`` or ``default_factory`` go to the field."""
    return field(metadata={"doc": doc, "unit": unit, "words": words}, **default)


_KINDS: dict[Any, Kind] = {str: "text", int: "whole", float: "number", bool: "yes/no"}


def columns_of(row: type) -> tuple[Column, ...]:
    """Return the columns of a table whose rows are instances of a dataclass, in order."""
    hints = typing.get_type_hints(row)
    return tuple(_column(f, hints[f.name]) for f in dataclasses.fields(row) if "doc" in f.metadata)


def _column(f: dataclasses.Field[Any], hint: Any) -> Column:
    optional = isinstance(hint, types.UnionType)
    plain = next(a for a in typing.get_args(hint) if a is not type(None)) if optional else hint
    kind: Kind = "list" if typing.get_origin(plain) is tuple else _KINDS[plain]
    return Column(f.name, kind, optional, f.metadata["doc"], f.metadata["unit"], f.metadata["words"])
