"""Instants on the wall clock, as ISO 8601 writes them."""

from __future__ import annotations

from datetime import datetime


def instant(text: str) -> datetime:
    """Return an instant; it must name its zone.

    Raises:
        ValueError: the text is no ISO 8601 instant, or has no zone.
    """
    found = datetime.fromisoformat(text)
    if found.tzinfo is None:
        raise ValueError(f"{text!r} names no time zone")
    return found
