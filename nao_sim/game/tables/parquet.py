"""A table as Parquet: typed, with the schema's version, units and meanings inside."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError
from nao_sim.game.tables.schema import Row, TableKind, arrow_schema


def to_parquet(kind: TableKind, rows: Sequence[object], derived: Sequence[dict[str, Any]] = ()) -> bytes:
    """Return rows, and beside each its derived cells if the kind has any, as the bytes of a file."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    cells: dict[str, list[Any]] = {"schema": [kind.stamp] * len(rows)}
    for c in kind.columns:
        values = [getattr(row, c.name) for row in rows]
        cells[c.name] = [list(v) for v in values] if c.kind == "list" else values
    for c in kind.derived:
        cells[c.name] = [d[c.name] for d in derived]
    sink = pa.BufferOutputStream()
    pq.write_table(pa.table(cells, schema=arrow_schema(kind)), sink)
    return sink.getvalue().to_pybytes()


def from_parquet(path: Path, kind: TableKind) -> list[Row]:
    """Read rows.

    Raises:
        GameError: the file is no Parquet, another table, or of a version that is not known.
    """
    import pyarrow as pa
    import pyarrow.parquet as pq

    try:
        table = pq.ParquetFile(path).read()
    except (pa.ArrowInvalid, pa.ArrowTypeError) as error:
        raise GameError(f"{path} cannot be read as Parquet ({error}); copy it anew") from None
    stamp = (table.schema.metadata or {}).get(b"nao_sim.schema", b"").decode(errors="replace")
    check_stamp(str(path), stamp, kind)
    check_names(str(path), table.column_names, kind)
    names = {c.name for c in kind.columns} & set(table.column_names)
    lists = {c.name for c in kind.columns if c.kind == "list"}
    return [
        kind.row(**{k: tuple(v) if k in lists else v for k, v in cells.items() if k in names})
        for cells in table.to_pylist()
    ]


def check_stamp(where: str, stamp: str, kind: TableKind) -> None:
    """Refuse another table, or a version of it that is not known."""
    if stamp == kind.stamp:
        return
    if stamp.startswith(f"{kind.name}/"):
        raise GameError(f"{where} says schema {stamp}, this nao-sim knows {kind.stamp}; use the one that wrote it")
    raise GameError(f"{where} is no table of {kind.name}: its schema says {stamp or 'nothing'}, not {kind.stamp}")


def check_names(where: str, names: Sequence[str], kind: TableKind) -> None:
    """Refuse columns that are missing or not known; names that begin with ``x_`` are the writer's own."""
    import dataclasses

    known = ["schema", *(c.name for c in kind.columns + kind.derived)]
    for name in names:
        if name not in known and not name.startswith("x_"):
            hint = did_you_mean(name, known)
            raise GameError(f"{where} has a column {name!r} that {kind.stamp} does not know{hint}; own columns: x_…")
    fields = {f.name: f for f in dataclasses.fields(kind.row)}
    for c in kind.columns:
        f = fields[c.name]
        needed = f.default is dataclasses.MISSING and f.default_factory is dataclasses.MISSING
        if needed and c.name not in names:
            raise GameError(f"{where} lacks the column {c.name!r} ({c.doc})")
