"""One child's course: points within phases, and each baseline against the game that follows it."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from nao_sim.game.statistics import PhasePair
from nao_sim.game.study.trials import Trial

FEWEST_POINTS = 3
"""A phase with fewer points by session is divided into blocks of turns."""

BLOCK = 5


@dataclass(frozen=True)
class CasePoint:
    """One point of a child's graph.

    Attributes:
        x: 1, 2, … over all of the child's points.
        session: the session it belongs to.
        total: sum of the outcome over its turns.
        counted: how many turns count.
    """

    x: int
    session: str
    total: Fraction
    counted: int

    @property
    def share(self) -> Fraction:
        """The outcome, 0 to 1."""
        return self.total / self.counted


@dataclass(frozen=True)
class CasePhase:
    """A phase of a child's graph: its name and its points in time order."""

    name: str
    condition: str
    points: tuple[CasePoint, ...]


@dataclass(frozen=True)
class ChildCase:
    """A child's course.

    Attributes:
        child: pseudonym.
        phases: in time order; a phase that returns is a phase of its own.
        blocks: turns a point, or 0 where a point is a session.
    """

    child: str
    phases: tuple[CasePhase, ...]
    blocks: int

    @property
    def pairs(self) -> tuple[PhasePair, ...]:
        """Each baseline with the game that follows it."""
        neighbours = zip(self.phases, self.phases[1:], strict=False)
        return tuple(
            PhasePair(tuple(p.share for p in a.points), tuple(p.share for p in b.points))
            for a, b in neighbours
            if a.name == "baseline" and b.name == "game"
        )


def child_cases(trials: Iterable[Trial], outcome: str, block: int = BLOCK) -> tuple[ChildCase, ...]:
    """Return each child's course through baseline and game.

    A point is a session where every phase has at least ``FEWEST_POINTS`` of them, else a block of turns of a session;
    a rest of less than half a block joins the block before it.

    Args:
        trials: the trials, in time order.
        outcome: an outcome of ``words.OUTCOMES``.
        block: turns a block.
    """
    mine: dict[str, list[Trial]] = {}
    for trial in trials:
        if trial.turn.phase in ("baseline", "game") and trial.outcome(outcome) is not None:
            mine.setdefault(trial.child, []).append(trial)
    return tuple(_case(child, found, outcome, block) for child, found in mine.items())


def _case(child: str, trials: list[Trial], outcome: str, block: int) -> ChildCase:
    runs: list[tuple[str, str, list[list[Trial]]]] = []
    for trial in trials:
        key = (trial.turn.phase, trial.turn.condition)
        if not runs or runs[-1][:2] != key:
            runs.append((*key, []))
        sittings = runs[-1][2]
        if not sittings or sittings[-1][0].turn.session != trial.turn.session:
            sittings.append([])
        sittings[-1].append(trial)
    by_session = all(len(sittings) >= FEWEST_POINTS for _, _, sittings in runs)
    phases, x = [], 0
    for name, condition, sittings in runs:
        groups = sittings if by_session else [part for sitting in sittings for part in _blocks(sitting, block)]
        points = []
        for group in groups:
            x += 1
            values = [value for value in (t.outcome(outcome) for t in group) if value is not None]
            points.append(CasePoint(x, group[0].turn.session, sum(values, Fraction(0)), len(values)))
        phases.append(CasePhase(name, condition, tuple(points)))
    return ChildCase(child, tuple(phases), 0 if by_session else block)


def _blocks(trials: Sequence[Trial], block: int) -> list[Sequence[Trial]]:
    parts = [trials[i : i + block] for i in range(0, len(trials), block)]
    if len(parts) > 1 and 2 * len(parts[-1]) < block:
        parts[-2:] = [[*parts[-2], *parts[-1]]]
    return parts
