"""Which tiers a session's tables become.

====================  ===========================================================================
``phase``             the session's phases
``model@WHO``         from the model's first movement to its end; the gesture
``turn@WHO``          the imitator's turns; the gesture asked for
``turn_id@WHO``       below it: the turn's key, by which everything finds its way back
``score@WHO@RATER``   below it: a rater's score
``auto@WHO``          below it: the automatic proposal
``side@WHO`` …        below it: side, prompt level, label seen, exclusion, where known
``movement@WHO``      from the imitator's first movement to the end
``speech@WHO``        what was said; below it ``function@WHO``: initiation, answer, other
``prompt@WHO`` …      moments, drawn 100 ms wide since ELAN has none without a length
====================  ===========================================================================
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

from nao_sim.exchange.elan.xml_text import xml_text
from nao_sim.exchange.extents import apart, extent
from nao_sim.exchange.times import milliseconds
from nao_sim.game.tables import Event, Tables, Turn
from nao_sim.game.tables.scores import AUTO, latest_ratings
from nao_sim.game.tables.words import SPEECH

MOMENT_MS = 100
STRETCH, MOMENT, ABOUT, FUNCTION = "stretch", "moment, drawn 100 ms wide", "about the turn", "function"
NO_TRIAL = "no trial"

Child = dict[int, str]
"""Values of annotations that refer to those of the parent tier, by their number there."""


@dataclass
class PlannedTier:
    """A tier with times of its own, and the tiers below it.

    Attributes:
        name, kind, participant: as ELAN knows them.
        stretches: start and end [ms] and value of each annotation, in time order, apart from each other.
        below: tiers that refer to it: name, type, annotator, values.
    """

    name: str
    kind: str
    participant: str | None
    stretches: list[tuple[int, int, str]]
    below: list[tuple[str, str, str | None, Child]] = field(default_factory=list)


def plan_tiers(tables: Tables) -> tuple[list[PlannedTier], list[str]]:
    """Return the tiers of one session, and notes on what has no time and so no place."""
    tiers, notes = [], []
    for who in dict.fromkeys(t.imitator for t in tables.turns):
        mine = [t for t in tables.turns if t.imitator == who]
        tiers.append(_turns(who, mine, tables))
        timeless = [t.turn_id for t in mine if extent(t) is None]
        if timeless:
            notes.append(f"without any time, so not in ELAN: {', '.join(timeless)}")
    tiers += _spans(tables.turns, "model", lambda t: (t.model, t.model_start_s, t.model_end_s))
    tiers += _spans(tables.turns, "movement", lambda t: (t.imitator, t.movement_start_s, t.movement_end_s))
    tiers += _events(tables.events)
    return [tier for tier in tiers if tier.stretches], notes


def _turns(who: str, turns: list[Turn], tables: Tables) -> PlannedTier:
    placed = sorted(((x, t) for t in turns if (x := extent(t)) is not None), key=lambda pair: pair[0][0])
    times = apart([(milliseconds(a), milliseconds(b)) for (a, b), _ in placed])
    shown = [t for _, t in placed]
    tier = PlannedTier(f"turn@{who}", STRETCH, who, [(*span, t.target) for span, t in zip(times, shown, strict=True)])
    about: list[tuple[str, Callable[[Turn], object]]] = [
        ("turn_id", lambda t: t.turn_id),
        ("prompt_level", lambda t: t.prompt_level),
        ("side", lambda t: t.side),
        ("seen", lambda t: t.seen),
        ("excluded", lambda t: t.excluded),
    ]
    for name, of in about:
        values = {i: str(of(t)) for i, t in enumerate(shown) if of(t) is not None}
        if values:
            tier.below.append((f"{name}@{who}", ABOUT, None, values))
    scale = tables.sessions[0].scale
    auto = {i: str(t.auto_score) for i, t in enumerate(shown) if t.auto_score is not None}
    if auto:
        tier.below.append((f"auto@{who}", f"score {scale}", AUTO, auto))
    ratings = latest_ratings(tables.ratings)
    for rater in sorted({r for t in shown for r in ratings.get(t.turn_id, {})}):
        found = {i: ratings[t.turn_id][rater] for i, t in enumerate(shown) if rater in ratings.get(t.turn_id, {})}
        scores = {i: NO_TRIAL if r.score is None else str(r.score) for i, r in found.items()}
        tier.below.append((f"score@{who}@{rater}", f"score {scale}", rater, scores))
    return tier


def _spans(
    turns: Iterable[Turn], kind: str, of: Callable[[Turn], tuple[str, float | None, float | None]]
) -> list[PlannedTier]:
    mine: dict[str, list[tuple[int, int, str]]] = {}
    for turn in turns:
        who, start, end = of(turn)
        if start is not None and end is not None:
            mine.setdefault(who, []).append((milliseconds(start), milliseconds(end), turn.target))
    return [PlannedTier(f"{kind}@{who}", STRETCH, who, _apart(spans)) for who, spans in mine.items()]


def _apart(spans: list[tuple[int, int, str]]) -> list[tuple[int, int, str]]:
    ordered = sorted(spans, key=lambda span: span[0])
    times = apart([span[:2] for span in ordered])
    return [(*time, span[2]) for time, span in zip(times, ordered, strict=True)]


def tier_of(event: Event) -> str:
    """Return the tier an event belongs on; one imported from ELAN goes back to its own."""
    if event.origin.startswith("ELAN "):
        return event.origin.removeprefix("ELAN ")
    return event.kind if event.who is None or event.kind == "phase" else f"{event.kind}@{event.who}"


def value_of(event: Event) -> str:
    """Return what an event's annotation says."""
    if event.kind == "speech":
        return event.text
    if event.kind == "prompt" and event.level is not None:
        return f"{event.level} {event.text}".strip()
    return event.text or event.label or event.kind


def span_of(event: Event) -> tuple[int, int]:
    """Return when an event's annotation begins and ends [ms]."""
    start = milliseconds(event.start_s)
    return start, start + MOMENT_MS if event.end_s is None else max(start + 1, milliseconds(event.end_s))


def event_tiers(events: Iterable[Event]) -> dict[str, list[tuple[tuple[int, int, str], Event]]]:
    """Return what events become: by tier the start and end [ms] and value of each annotation, with its event."""
    mine: dict[str, list[Event]] = {}
    for event in events:
        mine.setdefault(tier_of(event), []).append(event)
    tiers = {}
    for name, found in mine.items():
        found.sort(key=lambda e: e.start_s)
        times = apart([span_of(e) for e in found])
        tiers[name] = [((*time, xml_text(value_of(e))), e) for time, e in zip(times, found, strict=True)]
    return tiers


def _events(events: Iterable[Event]) -> list[PlannedTier]:
    tiers = []
    for name, found in event_tiers(events).items():
        first = found[0][1]
        kind = MOMENT if all(e.end_s is None for _, e in found) else STRETCH
        tier = PlannedTier(name, kind, None if first.kind == "phase" else first.who, [stretch for stretch, _ in found])
        labels = {i: e.label for i, (_, e) in enumerate(found) if e.kind == "speech" and e.label in SPEECH}
        if labels:
            tier.below.append((f"function@{name.partition('@')[2] or name}", FUNCTION, None, labels))
        tiers.append(tier)
    return tiers
