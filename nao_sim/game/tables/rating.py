"""One person's score of one turn, beside the automatic proposal and everybody else's."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.tables.column import column
from nao_sim.game.tables.words import EXCLUSIONS, RULES, SCALES, SIDES


@dataclass(frozen=True)
class Rating:
    """One row of ``ratings``. A rater who changes their mind adds a row; of their rows of a turn the latest counts."""

    turn_id: str = column("the turn that was rated")
    rater: str = column("who rated, by pseudonym")
    when: str = column("when, ISO 8601 with its zone")
    score: int | None = column("the score; none: the rater calls it no trial", default=None)
    scale: str = column("on which scale", words=SCALES, default="0/1")
    rule: str = column("by which rule", words=tuple(RULES), default="same_class")
    blind: bool = column("whether condition and order were hidden", default=False)
    position: int | None = column("the how-manieth turn shown to the rater in that sitting", default=None)
    side: str | None = column("the side, as the rater saw it", words=SIDES, default=None)
    excluded: str | None = column("why the rater calls it no trial", words=tuple(EXCLUSIONS), default=None)
    note: str = column("anything else", default="")
