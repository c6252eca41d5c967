"""Single cases: the children's graphs stacked over one axis, overlap and trend of each baseline and game."""

from __future__ import annotations

from dataclasses import dataclass

from markupsafe import Markup

from nao_sim.game.report.axes import Frame
from nao_sim.game.report.svg import Drawing
from nao_sim.game.report.words import percent, points, signed
from nao_sim.game.statistics import PhasePair
from nao_sim.game.study import ChildCase, StudyResult, child_cases
from nao_sim.game.study.single_case import FEWEST_POINTS
from nao_sim.game.tables.words import OUTCOMES

_LEFT, _WIDTH, _HEIGHT, _ROW = 92.0, 560.0, 110.0, 150.0


@dataclass(frozen=True)
class OverlapRow:
    """One baseline and the game after it, in words."""

    child: str
    points: str
    means: str
    nap: str
    tau: str
    trend: str
    note: str


@dataclass(frozen=True)
class CasePage:
    """What the template prints."""

    outcome: str
    what_is_a_point: str
    figure: Markup
    overlaps: tuple[OverlapRow, ...]


def case_page(result: StudyResult, block: int) -> CasePage | None:
    """Make the page of a study of single cases; None for other designs and without points.

    Args:
        result: the study.
        block: turns a point, where a phase has too few sessions.
    """
    cases = child_cases(result.trials, result.outcome, block)
    if result.design != "single_case" or not cases:
        return None
    by_block = [case.child for case in cases if case.blocks]
    what = "A point is a session."
    if by_block:
        of = "all children" if len(by_block) == len(cases) else ", ".join(by_block)
        what = f"A point is a block of {block} turns ({of}), since a phase has fewer than {FEWEST_POINTS} sessions."
        what += "" if len(by_block) == len(cases) else " For the others a point is a session."
    return CasePage(
        OUTCOMES[result.outcome], what, _figure(cases), tuple(_row(c.child, pair) for c in cases for pair in c.pairs)
    )


def _row(child: str, pair: PhasePair) -> OverlapRow:
    a, b = len(pair.baseline), len(pair.game)
    trend = "one point has no trend"
    notes = []
    if pair.baseline_tau is not None and pair.baseline_slope is not None:
        trend = f"Tau {signed(float(pair.baseline_tau))}, {points(pair.baseline_slope)} points a step"
        if pair.baseline_tau > 0:
            notes.append("the baseline rises by itself, so NAP overstates")
    if min(a, b) < FEWEST_POINTS:
        notes.append(f"a phase has fewer than {FEWEST_POINTS} points")
    return OverlapRow(
        child,
        f"{a} and {b}",
        f"{percent(sum(pair.baseline) / a)} and {percent(sum(pair.game) / b)}",
        f"{float(pair.nap):.2f}",
        signed(float(pair.tau)),
        trend,
        "; ".join(notes),
    )


def _figure(cases: tuple[ChildCase, ...]) -> Markup:
    last = max(phase.points[-1].x for case in cases for phase in case.phases)
    drawing = Drawing(680, _ROW * len(cases) + 24, "Each child's course through the phases")
    step = _WIDTH / last
    for row, case in enumerate(cases):
        frame = Frame(_LEFT, 26 + _ROW * row, _WIDTH, _HEIGHT)
        frame.draw(drawing)
        drawing.text(8, frame.top + _HEIGHT / 2, case.child, "child-label", "start")
        _phases(drawing, frame, case, step)
        for x in range(1, last + 1):
            drawing.text(_LEFT + step * (x - 0.5), frame.y(0) + 14, str(x), "tick")
    drawing.text(_LEFT + _WIDTH / 2, _ROW * len(cases) + 16, "session or block of turns, in time order", "tick")
    return drawing.markup()


def _phases(drawing: Drawing, frame: Frame, case: ChildCase, step: float) -> None:
    several = len({phase.condition for phase in case.phases}) > 1
    for number, phase in enumerate(case.phases):
        places = [(frame.left + step * (p.x - 0.5), frame.y(float(p.share))) for p in phase.points]
        if number:
            at = frame.left + step * (phase.points[0].x - 1)
            drawing.line(at, frame.top - 16, at, frame.y(0), "phase-line")
        label = f"{phase.name}, {phase.condition}" if several else phase.name
        drawing.text((places[0][0] + places[-1][0]) / 2, frame.top - 8, label, "phase-label")
        drawing.polyline(places, "course")  # within the phase only
        for (x, y), point in zip(places, phase.points, strict=True):
            drawing.dot(x, y, "point", f"{point.session}: {float(point.total):g} of {point.counted}")
