"""Which score of a turn is reported, whose it is, and whether a person has looked."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

from nao_sim.game.tables.instants import instant
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.turn import Turn

AUTO = "auto"
"""Whose the automatic proposal is; no person may be called so."""


@dataclass(frozen=True)
class Accepted:
    """What is reported of a turn.

    Attributes:
        score: the score; None where the turn is no trial or nobody scored it.
        by: the rater's pseudonym, ``auto`` for the proposal, None for nobody.
        confirmed: whether a person has rated the turn.
        excluded: why it is no trial, said by the game or by that rater; None: it is one.
        dispute: what a person has to settle, in words; empty for nothing.
    """

    score: int | None
    by: str | None
    confirmed: bool
    excluded: str | None
    dispute: str = ""


def latest_ratings(ratings: Iterable[Rating]) -> dict[str, dict[str, Rating]]:
    """Return each turn's ratings by rater; of a rater's own the latest, at equal times the later row."""
    found: dict[str, dict[str, Rating]] = {}
    for rating in ratings:
        mine = found.setdefault(rating.turn_id, {})
        old = mine.get(rating.rater)
        if old is None or instant(rating.when) >= instant(old.when):
            mine[rating.rater] = rating
    return found


def accept(turn: Turn, ratings: Mapping[str, Rating], primary: str | None) -> Accepted:
    """Choose what is reported of a turn.

    The primary rater's rating counts; where none is named, that of the person who first rated with the condition in
    sight, else who first rated at all. Without any person's the automatic proposal stands in, unconfirmed. A turn that
    the game or the chosen rater calls no trial has no score.

    Args:
        turn: the turn.
        ratings: its latest ratings by rater.
        primary: the session's primary rater, or None.
    """
    chosen = ratings.get(primary) if primary is not None else _first(ratings)
    if chosen is None:
        excluded = turn.excluded
        score = None if excluded else turn.auto_score
        return Accepted(score, None if score is None else AUTO, bool(ratings), excluded, _no_primary(ratings, primary))
    excluded = turn.excluded or chosen.excluded or ("other" if chosen.score is None else None)
    dispute = ""
    if turn.excluded and chosen.score is not None:
        dispute = f"{chosen.rater} scored a turn that the game excluded ({turn.excluded})"
    return Accepted(None if excluded else chosen.score, chosen.rater, True, excluded, dispute)


def _first(ratings: Mapping[str, Rating]) -> Rating | None:
    return min(ratings.values(), key=lambda r: (r.blind, instant(r.when), r.rater), default=None)


def _no_primary(ratings: Mapping[str, Rating], primary: str | None) -> str:
    return f"rated, but not by the primary rater {primary}" if ratings and primary is not None else ""
