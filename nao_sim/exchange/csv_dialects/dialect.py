"""How a CSV file is written."""

from __future__ import annotations

import csv
import io
from dataclasses import dataclass

from nao_sim.exchange.errors import ExchangeError

DELIMITERS = (",", ";", "\t", "|")


@dataclass(frozen=True)
class Dialect:
    """A dialect.

    Attributes:
        delimiter: between cells.
        decimal: before the decimals of a number, point or comma.
        bom: whether the file begins with a byte-order mark, as Excel likes it.
        clock: whether times are ``hh:mm:ss.mmm`` instead of seconds.
    """

    delimiter: str = ","
    decimal: str = "."
    bom: bool = False
    clock: bool = False

    def __post_init__(self) -> None:
        """Refuse what cannot be read back."""
        if self.delimiter not in DELIMITERS or self.decimal not in ".,":
            raise ExchangeError(
                f"delimiter {self.delimiter!r} with decimal {self.decimal!r}; choose of , ; tab | and . ,"
            )


def decode(where: str, content: bytes) -> str:
    """Return a file's text: UTF-8 with or without a mark, UTF-16 with one, else the Western Windows page.

    Raises:
        ExchangeError: it is none of these.
    """
    marked = content.startswith((b"\xff\xfe", b"\xfe\xff"))
    order = ["utf-16"] if marked else ["utf-8-sig", "cp1252"]
    for encoding in order:
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        if "\0" not in text:
            return text
    raise ExchangeError(f"{where} is no text that can be read; save it as CSV in UTF-8")


def detect_dialect(text: str, delimiter: str | None = None) -> Dialect:
    """Return the dialect of a text by the delimiter that divides its lines most evenly, and by its numbers.

    A first line ``sep=;``, which Excel writes, is believed, as is a ``delimiter`` that is given.
    """
    if delimiter is not None:
        return Dialect(delimiter, _decimal(text, Dialect(delimiter).delimiter))
    first = text.partition("\n")[0].strip()
    if first.lower().startswith("sep=") and first[4:5] in DELIMITERS:
        return Dialect(first[4], _decimal(text.partition("\n")[2], first[4]))
    best, score = ",", (0, 0)
    for candidate in DELIMITERS:
        rows = _rows(text, candidate)
        head = len(rows[0]) if rows else 0
        even = sum(len(row) == head for row in rows)
        if head > 1 and (even, head) > score:
            best, score = candidate, (even, head)
    return Dialect(best, _decimal(text, best))


def _rows(text: str, delimiter: str) -> list[list[str]]:
    reader = csv.reader(io.StringIO(text, newline=""), delimiter=delimiter)
    return [row for _, row in zip(range(200), reader, strict=False) if row]


def _decimal(text: str, delimiter: str) -> str:
    cells = [cell.strip() for row in _rows(text, delimiter)[1:] for cell in row]

    def numbers(sign: str) -> int:
        halves = (cell.lstrip("+-").split(sign) for cell in cells)
        return sum(len(h) == 2 and h[0].isdecimal() and h[1].isdecimal() for h in halves)

    return "," if numbers(",") > numbers(".") else "."
