"""What a study's design lets one say about its primary outcome."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from nao_sim.game.statistics import (
    Comparison,
    MixedModel,
    Verdicts,
    compare_groups,
    compare_pairs,
    fit_mixed_model,
    verdicts_of,
)
from nao_sim.game.study.children import ChildResult, child_results
from nao_sim.game.study.trials import Trial, trials_of
from nao_sim.game.tables import Session, Tables
from nao_sim.game.tables.words import CONDITIONS

_SETTINGS = ("primary_outcome", "margin", "scale", "success_at", "rule")
"""What all sessions of a study must have in common before anything is tested."""


@dataclass(frozen=True)
class StudyResult:
    """A study's result; conditions in the order of ``words.CONDITIONS``.

    Attributes:
        study, design: which.
        outcome: the primary outcome, named in the session files.
        sessions: the study's sessions.
        trials: all its trials.
        children: results of the game phase.
        baseline: results of the baseline phase.
        comparison: of the conditions; None where none was made.
        verdicts: what that lets one say; None for single cases, which are not compared as groups.
        model: the sensitivity analysis, or in words why there is none.
        obstacles: why nothing was tested although it should be, in words.
        left_out: children that count in no comparison, and why.
    """

    study: str
    design: str
    outcome: str
    sessions: tuple[Session, ...]
    trials: tuple[Trial, ...]
    children: tuple[ChildResult, ...]
    baseline: tuple[ChildResult, ...]
    comparison: Comparison | None
    verdicts: Verdicts | None
    model: MixedModel | str
    obstacles: tuple[str, ...]
    left_out: tuple[str, ...]

    def of(self, condition: str) -> tuple[ChildResult, ...]:
        """Return the game results of a condition's children that have an outcome."""
        return tuple(c for c in self.children if c.condition == condition and c.share is not None)

    def mean(self, condition: str, phase: str = "game") -> Fraction | None:
        """Return the unweighted mean of the children's outcomes; None without children."""
        results = self.children if phase == "game" else self.baseline
        return mean([c.share for c in results if c.condition == condition and c.share is not None])


def mean(values: Sequence[Fraction]) -> Fraction | None:
    """Return the mean, or None of nothing."""
    return sum(values, Fraction(0)) / len(values) if values else None


def study_results(tables: Tables) -> tuple[StudyResult, ...]:
    """Return the result of each study (sessions of one ``study`` and ``design``), in order of appearance."""
    groups: dict[tuple[str, str], list[Session]] = {}
    for session in tables.sessions:
        groups.setdefault((session.study, session.design), []).append(session)
    trials = trials_of(tables)
    found = []
    for (study, design), sessions in groups.items():
        names = {s.session for s in sessions}
        mine = tuple(trial for trial in trials if trial.turn.session in names)
        found.append(_result(study, design, tuple(sessions), mine))
    return tuple(found)


def _result(study: str, design: str, sessions: tuple[Session, ...], trials: tuple[Trial, ...]) -> StudyResult:
    outcome = sessions[0].primary_outcome
    results = child_results(trials, outcome)
    game = tuple(r for r in results if r.phase == "game")
    obstacles = tuple(_disagreements(sessions))
    comparison: Comparison | None = None
    model: MixedModel | str = "not for this design"
    left_out: list[str] = [f"{r.child}: no turn of the game counts ({r.condition})" for r in game if r.share is None]
    if design == "groups":
        obstacles += tuple(_in_both(game))
        if not obstacles:
            comparison, model = _groups(game, sessions[0].margin, outcome)
    elif design == "crossover":
        differences, alone = _pairs(game)
        left_out += alone
        if not obstacles:
            comparison = compare_pairs(differences, sessions[0].margin)
    judged = design != "single_case" and not obstacles
    return StudyResult(
        study=study,
        design=design,
        outcome=outcome,
        sessions=sessions,
        trials=trials,
        children=game,
        baseline=tuple(r for r in results if r.phase == "baseline"),
        comparison=comparison,
        verdicts=verdicts_of(comparison) if judged else None,
        model=model,
        obstacles=obstacles,
        left_out=tuple(left_out),
    )


def _disagreements(sessions: Sequence[Session]) -> Iterable[str]:
    first = sessions[0]
    for name in _SETTINGS:
        for other in sessions[1:]:
            if getattr(other, name) != getattr(first, name):
                a, b = getattr(first, name), getattr(other, name)
                yield f"{name} is {a} in {first.session} and {b} in {other.session}; nothing is tested until they agree"
                break


def _in_both(game: Sequence[ChildResult]) -> Iterable[str]:
    where: dict[str, set[str]] = {}
    for r in game:
        where.setdefault(r.child, set()).add(r.condition)
    for child, conditions in where.items():
        if len(conditions) > 1:
            yield f"{child} played in both conditions, which is a crossover and not groups; nothing is tested"


def _groups(
    game: Sequence[ChildResult], margin: float | None, outcome: str
) -> tuple[Comparison | None, MixedModel | str]:
    first, second = ([r for r in game if r.condition == c and r.share is not None] for c in CONDITIONS)
    shares = [[r.share for r in group if r.share is not None] for group in (first, second)]
    strata = ([r.stratum for r in first], [r.stratum for r in second])
    several = len({*strata[0], *strata[1]}) > 1
    comparison = compare_groups(shares[0], shares[1], margin, strata if several else None)
    if comparison is None:
        return None, "too few children"
    if outcome == "mean_score":
        return comparison, "only for outcomes that are successes of turns"
    both = [*first, *second]
    model = fit_mixed_model(
        np.array([int(r.total) for r in both]),
        np.array([r.counted for r in both]),
        np.array([r.condition == CONDITIONS[0] for r in both]),
    )
    return comparison, model


def _pairs(game: Sequence[ChildResult]) -> tuple[list[Fraction], list[str]]:
    """Return each child's difference of the conditions, and who has only one of them."""
    shares: dict[str, dict[str, Fraction]] = {}
    for r in game:
        if r.share is not None:
            shares.setdefault(r.child, {})[r.condition] = r.share
    first, second = CONDITIONS
    differences = [mine[first] - mine[second] for mine in shares.values() if len(mine) == 2]
    alone = [f"{child}: only the {next(iter(m))} condition" for child, m in shares.items() if len(m) == 1]
    return differences, alone
