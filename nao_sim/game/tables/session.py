"""What was agreed for a session: who, in which design, in what order, judged by which rule."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.tables.column import column
from nao_sim.game.tables.words import CONDITIONS, DESIGNS, OUTCOMES, RULES, SCALES


@dataclass(frozen=True)
class Session:
    """One row of ``sessions``: one sitting."""

    session: str = column("the session's name, unique in a study")
    started: str = column("wall clock at t = 0, ISO 8601 with its zone; every other time is in seconds from here")
    circle: tuple[str, ...] = column("who sits in the circle, in its order, each `role:pseudonym`")
    condition: str = column("who takes part", words=CONDITIONS)
    design: str = column("what the study compares, and how", words=DESIGNS)
    duration_s: float | None = column("from t = 0 to the closing's end", unit="s", default=None)
    study: str = column("which study it belongs to; sessions of one study and design are compared", default="")
    number: int | None = column("the child's how-manieth session; none: by date", default=None)
    assignment: str = column("how the condition, or the phase's start, was assigned", default="")
    randomised: bool = column("whether that assignment was really drawn at random", default=False)
    stratum: str | None = column("site or age band within which conditions are exchanged", default=None)
    order: str = column("whether the targets' order was listed or drawn", words=("fixed", "drawn"), default="fixed")
    seed: int | None = column("of the drawn order", default=None)
    planned: tuple[str, ...] = column("the targets of the child's turns in planned order", default=())
    direction: str = column(
        "in which direction turns go round", words=("clockwise", "counterclockwise"), default="clockwise"
    )
    time_limit_s: float | None = column("the game's fixed length; none: open end", unit="s", default=None)
    timeout_s: float | None = column("how long an answer is waited for after the model's end", unit="s", default=None)
    primary_outcome: str = column("the one outcome that is tested", words=tuple(OUTCOMES), default="independent")
    margin: float | None = column(
        "a difference of the outcome (share, 0 to 1) called equivalent when fixed beforehand", default=None
    )
    scale: str = column("the scores a rater may give", words=SCALES, default="0/1")
    success_at: int = column("the lowest score that counts as answered", default=1)
    rule: str = column("when an action counts as related to the target", words=tuple(RULES), default="same_class")
    rule_text: str = column("that rule in words", default="")
    primary_rater: str | None = column(
        "whose score is reported; none: the first person who rated the turn with the condition in sight", default=None
    )
    film: str | None = column("the session's film, relative to its folder", default=None)
    software: str = column("what played and recorded it", default="")
    note: str = column("anything else", default="")
