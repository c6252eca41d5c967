"""What a merge of another tool's file made of the tables."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.tables import Tables


@dataclass(frozen=True)
class Merged:
    """Tables after a merge.

    Attributes:
        tables: the new tables.
        news: what was added or corrected, a line each.
        notes: what could not be taken over as it is, or is missing from the file and was kept, a line each.
    """

    tables: Tables
    news: tuple[str, ...]
    notes: tuple[str, ...]
