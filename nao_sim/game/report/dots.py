"""Every child as a point, conditions side by side; what one may look at when there is nothing to test."""

from __future__ import annotations

from markupsafe import Markup

from nao_sim.game.report.axes import Frame
from nao_sim.game.report.svg import Drawing
from nao_sim.game.report.words import percent
from nao_sim.game.study import ChildResult, StudyResult
from nao_sim.game.tables.words import CONDITIONS

_FRAME = Frame(46, 16, 380, 190)


def dots_figure(result: StudyResult) -> Markup | None:
    """Draw the children of a study of groups or a crossover; None for single cases and without children."""
    if result.design == "single_case" or not any(result.of(c) for c in CONDITIONS):
        return None
    drawing = Drawing(440, 248, "Outcome of each child by condition")
    _FRAME.draw(drawing)
    centres = {c: _FRAME.left + _FRAME.width * (0.28 + 0.44 * i) for i, c in enumerate(CONDITIONS)}
    if result.design == "crossover":
        _join(drawing, result, centres)
    for condition, centre in centres.items():
        children = sorted(result.of(condition), key=lambda c: (c.share or 0, c.child))
        for child, x in zip(children, _spread(children, centre, result.design), strict=True):
            draw = drawing.dot if condition == CONDITIONS[0] else drawing.square
            draw(x, _FRAME.y(float(child.share or 0)), condition, f"{child.child}: {percent(child.share)}")
        mean = result.mean(condition)
        if mean is not None:
            drawing.line(centre - 62, _FRAME.y(float(mean)), centre + 62, _FRAME.y(float(mean)), "mean")
            drawing.text(centre + 66, _FRAME.y(float(mean)) + 4, percent(mean), "value", "start")
        n = len(children)
        drawing.text(centre, _FRAME.y(0) + 18, f"{condition}, {n} {'child' if n == 1 else 'children'}", "phase-label")
    return drawing.markup()


def _spread(children: list[ChildResult], centre: float, design: str) -> list[float]:
    if design == "crossover":
        return [centre] * len(children)
    step = min(16.0, 110 / max(1, len(children)))
    return [centre + step * (i - (len(children) - 1) / 2) for i in range(len(children))]


def _join(drawing: Drawing, result: StudyResult, centres: dict[str, float]) -> None:
    first, second = ({c.child: c for c in result.of(condition)} for condition in CONDITIONS)
    for child in first.keys() & second.keys():
        ends = [(centres[CONDITIONS[i]], _FRAME.y(float(c[child].share or 0))) for i, c in enumerate((first, second))]
        drawing.polyline(ends, "pair")
