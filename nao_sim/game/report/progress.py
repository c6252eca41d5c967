"""A child's sessions side by side: independent answers of valid turns, baseline and game apart."""

from __future__ import annotations

from collections.abc import Sequence

from markupsafe import Markup

from nao_sim.game.report.axes import Frame
from nao_sim.game.report.svg import Drawing
from nao_sim.game.report.words import day
from nao_sim.game.study import Trial
from nao_sim.game.tables import Session

_FRAME = Frame(46, 22, 610, 96)


def progress_figure(trials: Sequence[Trial], sessions: Sequence[Session]) -> Markup | None:
    """Draw the progress of one child; None where fewer than two points can be drawn.

    Args:
        trials: the child's trials, in time order.
        sessions: their sessions, in time order.
    """
    runs: list[tuple[str, str, list[tuple[int, int, int]]]] = []  # phase, condition, (session, k, n)
    for at, session in enumerate(sessions):
        of_session = [t for t in trials if t.turn.session == session.session]
        for phase in dict.fromkeys(t.turn.phase for t in of_session):
            counted = [t for t in of_session if t.turn.phase == phase and t.outcome("independent") is not None]
            if not counted:
                continue
            key = (phase, session.condition)
            if not runs or runs[-1][:2] != key:
                runs.append((*key, []))
            runs[-1][2].append((at, sum(t.independent for t in counted), len(counted)))
    flat = sum(len(points) for _, _, points in runs)
    if flat < 2:
        return None
    drawing = Drawing(680, 150, "Independent answers by session")
    _FRAME.draw(drawing)
    step = _FRAME.width / flat
    x = _FRAME.left + step / 2
    for i, (phase, condition, points) in enumerate(runs):
        if i:
            drawing.line(x - step / 2, _FRAME.top - 14, x - step / 2, _FRAME.y(0), "phase-line")
        label = phase if len({c for _, c, _ in runs}) == 1 else f"{phase}, {condition}"
        places = [x + j * step for j in range(len(points))]
        drawing.text((places[0] + places[-1]) / 2, _FRAME.top - 8, label, "phase-label")
        drawing.polyline([(p, _FRAME.y(k / n)) for p, (_, k, n) in zip(places, points, strict=True)], "course")
        for p, (at, k, n) in zip(places, points, strict=True):
            name = f"{sessions[at].session}, {day(sessions[at].started)}: {k} of {n}"
            drawing.dot(p, _FRAME.y(k / n), "point", name)
            drawing.text(p, _FRAME.y(k / n) + (16 if k / n > 0.8 else -8), f"{k}/{n}", "value")
            drawing.text(p, _FRAME.y(0) + 16, sessions[at].session, "tick")
        x = places[-1] + step
    return drawing.markup()
