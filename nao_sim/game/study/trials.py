"""A trial: a turn in which a child was to imitate, with what is reported of it."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from nao_sim.game.tables import Session, Tables, Turn
from nao_sim.game.tables.scores import AUTO, Accepted, accept, latest_ratings


@dataclass(frozen=True)
class Trial:
    """A child's turn.

    Attributes:
        turn: the turn.
        session: its session.
        accepted: the score that is reported, whose it is, or why it is no trial.
    """

    turn: Turn
    session: Session
    accepted: Accepted

    @property
    def child(self) -> str:
        """Pseudonym of the child."""
        return self.turn.imitator

    @property
    def valid(self) -> bool:
        """Whether it counts in a denominator: no exclusion, and scored."""
        return self.accepted.excluded is None and self.accepted.score is not None

    @property
    def proposed(self) -> bool:
        """Whether its score is the automatic proposal that no person has confirmed."""
        return self.accepted.by == AUTO

    @property
    def success(self) -> bool:
        """Whether the score is a success, at whatever prompt level."""
        return self.valid and (self.accepted.score or 0) >= self.session.success_at

    @property
    def independent(self) -> bool:
        """Whether it is a success without any prompt."""
        return self.success and self.turn.prompt_level == 0

    def outcome(self, name: str) -> Fraction | None:
        """Return what the trial adds to an outcome of ``words.OUTCOMES``, 0 to 1; None where it does not count."""
        if not self.valid:
            return None
        if name == "independent":
            return None if self.turn.prompt_level is None else Fraction(self.independent)
        if name == "success":
            return Fraction(self.success)
        return Fraction(self.accepted.score or 0, int(self.session.scale.split("/")[-1]))


def trials_of(tables: Tables) -> tuple[Trial, ...]:
    """Return the trials of some sessions, those without a valid score too, in the turns' order."""
    sessions = {s.session: s for s in tables.sessions}
    ratings = latest_ratings(tables.ratings)
    children: Iterable[Turn] = (t for t in tables.turns if t.imitator_role == "child")
    return tuple(
        Trial(t, s, accept(t, ratings.get(t.turn_id, {}), s.primary_rater))
        for t in children
        for s in (sessions[t.session],)
    )
