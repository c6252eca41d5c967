"""Two more tables that a report stores: children and points, the units of what it says."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.study import StudyResult, child_cases
from nao_sim.game.tables.column import column, columns_of
from nao_sim.game.tables.schema import TableKind


@dataclass(frozen=True)
class ChildLine:
    """One row of ``children``: a child's outcome in one condition and phase."""

    study: str = column("the study")
    design: str = column("its design")
    child: str = column("pseudonym of the child")
    condition: str = column("the condition")
    phase: str = column("baseline or game")
    stratum: str = column("site or age band; empty for none")
    outcome: str = column("the primary outcome")
    total: float = column("its sum over the turns that count")
    counted: int = column("how many turns count")
    share: float | None = column("total / counted; none: nothing counts")
    turns: int = column("all of the child's turns")
    excluded: int = column("turns that are no trial")
    proposed: int = column("turns whose score no person has confirmed")


@dataclass(frozen=True)
class PointLine:
    """One row of ``points``: a point of a single case's graph."""

    study: str = column("the study")
    child: str = column("pseudonym of the child")
    phase_number: int = column("number of the child's phase, from 1")
    phase: str = column("baseline or game")
    condition: str = column("the condition")
    x: int = column("number of the child's point, from 1")
    session: str = column("the session it belongs to")
    total: float = column("the outcome's sum over its turns")
    counted: int = column("how many turns count")
    share: float = column("total / counted")


CHILDREN = TableKind("children", ChildLine, columns_of(ChildLine), ())
POINTS = TableKind("points", PointLine, columns_of(PointLine), ())


def child_lines(results: tuple[StudyResult, ...]) -> list[ChildLine]:
    """Return the rows of ``children``."""
    return [
        ChildLine(
            r.study, r.design, c.child, c.condition, c.phase, c.stratum, r.outcome, float(c.total), c.counted,
            None if c.share is None else float(c.share), c.turns, sum(c.excluded.values()), c.proposed,
        )
        for r in results
        for c in (*r.baseline, *r.children)
    ]  # fmt: skip


def point_lines(results: tuple[StudyResult, ...], block: int) -> list[PointLine]:
    """Return the rows of ``points``, of single cases."""
    return [
        PointLine(
            r.study, case.child, number, phase.name, phase.condition, p.x, p.session, float(p.total), p.counted,
            float(p.share),
        )
        for r in results
        if r.design == "single_case"
        for case in child_cases(r.trials, r.outcome, block)
        for number, phase in enumerate(case.phases, 1)
        for p in phase.points
    ]  # fmt: skip
