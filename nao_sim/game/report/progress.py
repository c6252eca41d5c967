"""A child's sessions side by side: independent answers of valid turns, baseline and game apart."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import groupby

from markupsafe import Markup

from nao_sim.game.report.axes import Frame
from nao_sim.game.report.svg import Drawing
from nao_sim.game.report.words import day, listed
from nao_sim.game.study import Trial
from nao_sim.game.tables import Session

_FRAME = Frame(46, 38, 610, 96)

_Count = tuple[Session, dict[str, tuple[int, int]]]
"""A session, and of each of its phases how many independent answers of how many that count."""


def progress_figure(trials: Sequence[Trial], sessions: Sequence[Session]) -> Markup | None:
    """Draw the progress of one child; None where fewer than two sessions can be drawn.

    Args:
        trials: the child's trials, in time order.
        sessions: their sessions, in time order.
    """
    counts = [(session, _by_phase(trials, session)) for session in sessions]
    counts = [(session, phases) for session, phases in counts if phases]
    if len(counts) < 2:
        return None
    drawing = Drawing(680, 162, "Independent answers by session")
    _FRAME.draw(drawing)
    step = _FRAME.width / len(counts)
    at = 0
    several = len({session.condition for session, _ in counts}) > 1
    for (phases, condition), group in groupby(counts, key=lambda c: (tuple(c[1]), c[0].condition)):
        run = list(group)
        places = [_FRAME.left + step * (at + i + 0.5) for i in range(len(run))]
        if at:
            drawing.line(places[0] - step / 2, _FRAME.top - 32, places[0] - step / 2, _FRAME.y(0), "phase-line")
        label = listed(phases) + (f", {condition}" if several else "")
        drawing.text((places[0] + places[-1]) / 2, _FRAME.top - 24, label, "phase-label")
        for phase in phases:
            _draw(drawing, phase, places, run)
        for x, (session, _) in zip(places, run, strict=True):
            drawing.text(x, _FRAME.y(0) + 16, session.session, "tick")
        at += len(run)
    return drawing.markup()


def _by_phase(trials: Sequence[Trial], session: Session) -> dict[str, tuple[int, int]]:
    found: dict[str, tuple[int, int]] = {}
    for trial in trials:
        if trial.session == session and trial.outcome("independent") is not None:
            k, n = found.get(trial.turn.phase, (0, 0))
            found[trial.turn.phase] = (k + trial.independent, n + 1)
    return found


def _draw(drawing: Drawing, phase: str, places: Sequence[float], run: Sequence[_Count]) -> None:
    heights = [_FRAME.y(phases[phase][0] / phases[phase][1]) for _, phases in run]
    drawing.polyline(list(zip(places, heights, strict=True)), "course" if phase == "game" else "faint")
    for x, y, (session, phases) in zip(places, heights, run, strict=True):
        k, n = phases[phase]
        draw = drawing.dot if phase == "game" else drawing.square
        draw(x, y, "point" if phase == "game" else "before", f"{phase}, {day(session.started)}: {k} of {n}")
        below = phase != "game" and k / n > 0.2
        drawing.text(x, y + 16 if below else y - 8, f"{k}/{n}", "value")
