"""A CSV file as named columns of text; nothing is turned into a number before somebody says what it is."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass, replace

from nao_sim.exchange.csv_dialects.dialect import Dialect, decode, detect_dialect
from nao_sim.exchange.errors import ExchangeError
from nao_sim.game.tables.csv_text import unguard_text


@dataclass(frozen=True)
class Sheet:
    """A file's cells.

    Attributes:
        where: the file.
        dialect: as given or found.
        columns: the names in the first line.
        rows: line number and cells of each further line.
    """

    where: str
    dialect: Dialect
    columns: tuple[str, ...]
    rows: tuple[tuple[int, tuple[str, ...]], ...]


def read_sheet(where: str, content: bytes, delimiter: str | None = None, decimal: str | None = None) -> Sheet:
    """Read a file.

    Args:
        where: its name, for errors.
        content: its bytes.
        delimiter: between cells; None: find out.
        decimal: before decimals, point or comma; None: find out.

    Raises:
        ExchangeError: it is no text, has no columns, two of one name, or a line of another width.
    """
    text = decode(where, content).removeprefix("\ufeff")
    found = detect_dialect(text, delimiter)
    if decimal is not None:
        found = replace(found, decimal=decimal)
    lines = csv.reader(io.StringIO(text, newline=""), delimiter=found.delimiter)
    head: list[str] | None = None
    rows = []
    try:
        for cells in lines:
            if not any(cell.strip() for cell in cells):
                continue
            if head is None:
                if (len(cells) == 1 and cells[0].lower().startswith("sep=")) or cells[0].lower() == "sep=":
                    continue
                head = [cell.strip() for cell in cells]
                continue
            while len(cells) > len(head) and not cells[-1]:
                cells.pop()
            if len(cells) != len(head):
                raise ExchangeError(
                    f"{where} line {lines.line_num}: {len(cells)} cells under {len(head)} columns "
                    f"(cells divided by {found.delimiter!r})"
                )
            rows.append((lines.line_num, tuple(unguard_text(cell) for cell in cells)))
    except csv.Error as error:
        raise ExchangeError(f"{where} line {lines.line_num}: {error}") from None
    if head is None:
        raise ExchangeError(f"{where} is empty; its first line must name the columns")
    twice = {name for name in head if head.count(name) > 1}
    if twice:
        raise ExchangeError(f"{where} has two columns {sorted(twice)[0]!r}; rename one")
    return Sheet(where, found, tuple(head), tuple(rows))
