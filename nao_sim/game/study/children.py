"""What each child did: the unit of every comparison."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable
from dataclasses import dataclass
from fractions import Fraction

from nao_sim.game.statistics import LatencySummary, summarise_latency
from nao_sim.game.study.trials import Trial


@dataclass(frozen=True)
class ChildResult:
    """A child's trials of one condition and phase.

    Attributes:
        child, condition, phase: whose, and which.
        stratum: the sessions' stratum, empty for none.
        turns: all trials, valid or not.
        counted: those that count for the outcome.
        total: the sum of the outcome over them.
        successes: of the valid ones, how many succeeded at whatever prompt level.
        valid: how many were scored and not excluded.
        excluded: how many were excluded, by reason.
        unscored: how many nobody scored.
        unprompted: valid ones whose prompt level was not recorded.
        proposed: valid ones with an unconfirmed automatic score.
        latency: of the valid ones.
    """

    child: str
    condition: str
    phase: str
    stratum: str
    turns: int
    counted: int
    total: Fraction
    successes: int
    valid: int
    excluded: dict[str, int]
    unscored: int
    unprompted: int
    proposed: int
    latency: LatencySummary

    @property
    def share(self) -> Fraction | None:
        """The child's outcome, 0 to 1; None where nothing counts."""
        return self.total / self.counted if self.counted else None


def child_results(trials: Iterable[Trial], outcome: str) -> tuple[ChildResult, ...]:
    """Return the result of each child, condition and phase, in order of appearance.

    Args:
        trials: the trials.
        outcome: an outcome of ``words.OUTCOMES``.
    """
    groups: dict[tuple[str, str, str], list[Trial]] = {}
    for trial in trials:
        groups.setdefault((trial.child, trial.turn.condition, trial.turn.phase), []).append(trial)
    return tuple(_result(*key, mine, outcome) for key, mine in groups.items())


def _result(child: str, condition: str, phase: str, trials: list[Trial], outcome: str) -> ChildResult:
    values = [value for value in (trial.outcome(outcome) for trial in trials) if value is not None]
    valid = [trial for trial in trials if trial.valid]
    return ChildResult(
        child=child,
        condition=condition,
        phase=phase,
        stratum=trials[0].session.stratum or "",
        turns=len(trials),
        counted=len(values),
        total=sum(values, Fraction(0)),
        successes=sum(trial.success for trial in valid),
        valid=len(valid),
        excluded=dict(Counter(t.accepted.excluded for t in trials if t.accepted.excluded)),
        unscored=sum(t.accepted.excluded is None and t.accepted.score is None for t in trials),
        unprompted=sum(trial.turn.prompt_level is None for trial in valid),
        proposed=sum(trial.proposed for trial in valid),
        latency=latency_of(valid),
    )


def latency_of(trials: Iterable[Trial]) -> LatencySummary:
    """Summarise the latencies of some trials; those without a recorded latency or wait are left out."""
    turns = [trial.turn for trial in trials]
    return summarise_latency(
        [t.latency_s for t in turns if t.latency_s is not None],
        [t.waited_s for t in turns if t.latency_censored and t.waited_s is not None],
    )
