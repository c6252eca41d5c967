"""The therapist's page: one child, one session, one A4; words, counts, no p value, no face."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from markupsafe import Markup

from nao_sim.game.report.child_notes import not_counted, still_to_do, technical_faults
from nao_sim.game.report.progress import progress_figure
from nao_sim.game.report.strip import StripCell, strip_cells
from nao_sim.game.report.words import day, day_and_time, gesture_title, minutes
from nao_sim.game.study import Gathered, Trial
from nao_sim.game.tables import Event, Session


@dataclass(frozen=True)
class GestureCount:
    """How often a gesture was answered: independently of those counted for that, with any help of the valid ones."""

    title: str
    independent: int
    counted: int
    answered: int
    valid: int


@dataclass(frozen=True)
class ChildPage:
    """What the template prints; texts are plain, the template escapes them."""

    anchor: str
    child: str
    session: str
    when: str
    details: str
    headline: str
    with_help: str
    before: tuple[str, ...]
    unconfirmed: int
    turns: int
    strips: tuple[tuple[str, tuple[StripCell, ...]], ...]
    gestures: tuple[GestureCount, ...]
    speech: str
    not_counted: tuple[str, ...]
    technical: tuple[str, ...]
    to_do: tuple[str, ...]
    progress: Markup | None


def child_page(gathered: Gathered, session: Session, child: str, trials: Sequence[Trial], report: Path) -> ChildPage:
    """Make a page.

    Args:
        gathered: all sessions.
        session: the session it is about.
        child: the child it is about.
        trials: all of that child's trials, in time order.
        report: the folder of the report, from which films are linked.
    """
    tables = gathered.tables
    here = [t for t in trials if t.turn.session == session.session]
    order = [s.session for s in tables.sessions]
    earlier = [t for t in trials if order.index(t.turn.session) < order.index(session.session)]
    main = _main_phase(here)
    of_main = [t for t in here if t.turn.phase == main]
    events = [e for e in tables.events if e.session == session.session]
    ratings = [r for r in tables.ratings if r.turn_id in {t.turn.turn_id for t in here}]
    phases = list(dict.fromkeys(t.turn.phase for t in here))
    seen = [*earlier, *here]
    return ChildPage(
        anchor=f"{session.session}-{child}",
        child=child,
        session=session.session,
        when=day_and_time(session.started),
        details=_details(session, here, len([t for t in tables.turns if t.session == session.session])),
        headline=f"{_independent(of_main)} independent",
        with_help=f"{sum(t.success for t in of_main)} of {sum(t.valid for t in of_main)} with or without help",
        before=_before(earlier, here, main),
        unconfirmed=sum(t.proposed for t in of_main),
        turns=len(here),
        strips=tuple(
            (phase, strip_cells([t for t in here if t.turn.phase == phase], gathered.folders[session.session], report))
            for phase in phases
        ),
        gestures=_gestures(of_main),
        speech=_speech(events, child, session),
        not_counted=tuple(not_counted(here)),
        technical=tuple(technical_faults(here, events)),
        to_do=tuple(still_to_do(here, ratings)),
        progress=progress_figure(seen, [s for s in tables.sessions if s.session in {t.turn.session for t in seen}]),
    )


def _main_phase(trials: Sequence[Trial]) -> str:
    phases = [t.turn.phase for t in trials]
    return "game" if "game" in phases or not phases else phases[0]


def _independent(trials: Sequence[Trial]) -> str:
    counted = [t for t in trials if t.outcome("independent") is not None]
    return f"{sum(t.independent for t in counted)} of {len(counted)}"


def _details(session: Session, trials: Sequence[Trial], turns: int) -> str:
    with_whom = {"triadic": "child, therapist and robot", "dyadic": "child and therapist"}[session.condition]
    length = [] if session.duration_s is None else [minutes(session.duration_s)]
    return " · ".join([*length, with_whom, f"{turns} turns in the circle, {len(trials)} of them the child's"])


def _before(earlier: Sequence[Trial], here: Sequence[Trial], main: str) -> tuple[str, ...]:
    lines = []
    last = [t for t in earlier if t.turn.phase == main]
    if last:
        latest = last[-1].session
        other = f", {latest.condition}" if here and latest.condition != here[0].session.condition else ""
        count = _independent([t for t in last if t.session == latest])
        lines.append(f"Last time ({day(latest.started)}{other}): {count} independent")
    baseline = [t for t in [*earlier, *here] if t.turn.phase == "baseline"]
    if baseline and main != "baseline":
        lines.append(f"Baseline: {_independent(baseline)} independent")
    return tuple(lines) or ("First session; nothing to compare with yet",)


def _gestures(trials: Sequence[Trial]) -> tuple[GestureCount, ...]:
    counts = []
    for target in dict.fromkeys(t.turn.target for t in trials):
        valid = [t for t in trials if t.turn.target == target and t.valid]
        counted = [t for t in valid if t.outcome("independent") is not None]
        counts.append(
            GestureCount(
                gesture_title(target),
                sum(t.independent for t in counted),
                len(counted),
                sum(t.success for t in valid),
                len(valid),
            )
        )
    return tuple(counts)


def _speech(events: Sequence[Event], child: str, session: Session) -> str:
    said = [e for e in events if e.kind == "speech"]
    if not said:
        return "Nobody has annotated speech in this session."
    mine = [e for e in said if e.who == child]
    parts = []
    for label, one, many in (("initiation", "initiation", "initiations"), ("answer", "answer", "answers")):
        n = sum(e.label == label for e in mine)
        rate = f" ({60 * n / session.duration_s:.1f} a minute)" if session.duration_s and n else ""
        parts.append(f"{n} {one if n == 1 else many}{rate}")
    other = sum(e.label not in ("initiation", "answer") for e in mine)
    return ", ".join(parts + ([f"{other} other"] if other else []))
