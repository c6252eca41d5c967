"""Everybody who scored a set of turns, the automatic proposal among them but apart."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from itertools import combinations

from nao_sim.game.agreement.alpha import nominal_alpha
from nao_sim.game.agreement.measure import Measure
from nao_sim.game.agreement.pairs import PairAgreement, pair_agreement
from nao_sim.game.tables.rating import Rating
from nao_sim.game.tables.scores import AUTO, latest_ratings
from nao_sim.game.tables.turn import Turn


@dataclass(frozen=True)
class Coverage:
    """Of the trials of one condition and phase, how many at least two people scored."""

    condition: str
    phase: str
    twice: int
    trials: int


@dataclass(frozen=True)
class Panel:
    """Agreement on a set of turns.

    Attributes:
        people: each two people who scored turns in common.
        proposals: the automatic proposal against each person.
        alpha: over all people, gaps allowed; the proposal is no rater.
        no_trial: keys of turns that some people scored and others called no trial.
        coverage: how much was scored twice, by condition and phase.
    """

    people: tuple[PairAgreement, ...]
    proposals: tuple[PairAgreement, ...]
    alpha: Measure
    no_trial: tuple[str, ...]
    coverage: tuple[Coverage, ...]


def panel_of(turns: Iterable[Turn], ratings: Iterable[Rating], scale: str) -> Panel:
    """Compare all raters of the trials among some turns.

    Args:
        turns: the turns; those that the game excluded are no trials and are left out.
        ratings: ratings, those of other turns too.
        scale: ``0/1`` or ``0/1/2``; ratings on another scale are left out.
    """
    trials = [turn for turn in turns if turn.is_trial]
    found = latest_ratings(rating for rating in ratings if rating.scale == scale)
    scores: dict[str, dict[str, int]] = {}
    disputed = []
    for turn in trials:
        mine = found.get(turn.turn_id, {})
        for rater, rating in mine.items():
            if rating.score is not None:
                scores.setdefault(rater, {})[turn.turn_id] = rating.score
        if len({rating.score is None for rating in mine.values()}) == 2:
            disputed.append(turn.turn_id)
    levels = tuple(int(level) for level in scale.split("/"))
    raters = sorted(scores)
    pairs = (pair_agreement((a, scores[a]), (b, scores[b]), levels) for a, b in combinations(raters, 2))
    auto = {t.turn_id: t.auto_score for t in trials if t.auto_score is not None and t.auto_scale == scale}
    return Panel(
        people=tuple(pair for pair in pairs if pair.both),
        proposals=tuple(pair_agreement((AUTO, auto), (r, scores[r]), levels) for r in raters if auto),
        alpha=nominal_alpha([scores[r].get(turn.turn_id) for r in raters] for turn in trials),
        no_trial=tuple(disputed),
        coverage=_coverage(trials, scores),
    )


def _coverage(trials: list[Turn], scores: dict[str, dict[str, int]]) -> tuple[Coverage, ...]:
    all_, twice = Counter[tuple[str, str]](), Counter[tuple[str, str]]()
    for turn in trials:
        key = (turn.condition, turn.phase)
        all_[key] += 1
        twice[key] += sum(turn.turn_id in mine for mine in scores.values()) >= 2
    return tuple(Coverage(*key, twice[key], n) for key, n in all_.items())
