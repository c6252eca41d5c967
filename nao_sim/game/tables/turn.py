"""One turn: somebody modelled a gesture, the neighbour answered, the automatic score is a proposal."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.tables.column import column
from nao_sim.game.tables.words import CONDITIONS, DESIGNS, EXCLUSIONS, PHASES, ROLES, RULES, SCALES, SIDES

_FROM = "seconds from the session's start"


@dataclass(frozen=True)
class Turn:
    """One row of ``turns``. What people score stands in ``ratings``; nothing here is changed by it."""

    turn_id: str = column("the turn's key, unique in a study: session, a slash, the turn's number")
    session: str = column("the session it belongs to")
    turn: int = column("number of the turn in played order, from 1")
    phase: str = column("the session's phase", words=PHASES)
    condition: str = column("who takes part, as in the session", words=CONDITIONS)
    design: str = column("the study's design, as in the session", words=DESIGNS)
    model: str = column("pseudonym of who modelled")
    model_role: str = column("their role", words=ROLES)
    imitator: str = column("pseudonym of who was to imitate")
    imitator_role: str = column("their role; a turn whose imitator is a child is a trial", words=ROLES)
    target: str = column("the gesture to be imitated")

    instruction_s: float | None = column(f"the instruction's start, {_FROM}", unit="s", default=None)
    model_start_s: float | None = column(f"the model's first movement, {_FROM}", unit="s", default=None)
    model_end_s: float | None = column(f"the model's end, {_FROM}", unit="s", default=None)
    movement_start_s: float | None = column(f"the imitator's first movement, {_FROM}", unit="s", default=None)
    movement_end_s: float | None = column(f"the imitator's end, {_FROM}", unit="s", default=None)
    prompt_s: float | None = column(f"the last prompt before the answer, {_FROM}", unit="s", default=None)
    praise_s: float | None = column(f"the praise's start, {_FROM}", unit="s", default=None)

    prompt_level: int | None = column(
        "most help given before the answer: 0 independent, 1 verbal, 2 model again, 3 partial help, 4 full help; "
        "none: not recorded",
        default=None,
    )
    latency_s: float | None = column(
        "model's end to movement's start; never the time-out's value", unit="s", default=None
    )
    latency_censored: bool = column("whether the wait ended before any movement began", default=False)
    waited_s: float | None = column("how long a censored wait was, from the model's end", unit="s", default=None)

    seen: str | None = column("the label recognised; none: rejected or not looked at", default=None)
    seen_distance: float | None = column("distance of what was seen to the known, as the recogniser says", default=None)
    seen_limit: float | None = column("the distance from which it rejects", default=None)
    seen_reason: str = column("why that label, or why none, in words", default="")
    seen_among: tuple[str, ...] = column("the labels it had to decide between; empty: all", default=())
    answer_delay_s: float | None = column("end of the clip to the robot's first command", unit="s", default=None)

    side: str | None = column(
        "the imitator's side against the model's; none: the gesture has no side, or nothing was seen",
        words=SIDES,
        default=None,
    )
    auto_score: int | None = column("the automatic score, a proposal; none: none was made", default=None)
    auto_rule: str | None = column("by which rule", words=tuple(RULES), default=None)
    auto_scale: str | None = column("on which scale", words=SCALES, default=None)

    excluded: str | None = column("why this is no trial; none: it is one", words=tuple(EXCLUSIONS), default=None)
    excluded_note: str = column("that reason in more words", default="")

    clip: str | None = column("the answer's clip, relative to the session's folder", default=None)
    film: str | None = column("the film that shows the turn, relative to the session's folder", default=None)
    film_s: float | None = column("where in that film the turn begins", unit="s", default=None)
    episode: str | None = column("the robot's episode folder of this turn, relative likewise", default=None)
    note: str = column("anything else", default="")

    @property
    def is_trial(self) -> bool:
        """Whether a child was to imitate and nothing excludes the turn."""
        return self.imitator_role == "child" and self.excluded is None
