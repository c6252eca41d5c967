"""An annotation as an event."""

from __future__ import annotations

import re

from nao_sim.exchange.elan.layout import MOMENT, MOMENT_MS
from nao_sim.exchange.elan.reading import ReadAnnotation, ReadTier
from nao_sim.game.tables import Event

_PROMPT = re.compile(r"([1-4])(?:\s+(.*))?", re.DOTALL)


def event_from(
    session: str, tier: ReadTier, a: ReadAnnotation, kind: str, label: str | None, origin: str, turn: str | None
) -> Event | None:
    """Return the event of an annotation; None where it has no time.

    Args:
        session: the session's name.
        tier: the annotation's tier.
        a: the annotation, with the times of what it refers to.
        kind: the kind of event.
        label: of speech, its function.
        origin: the tier it shall go back to.
        turn: the turn it belongs to.
    """
    if a.start_s is None or a.end_s is None:
        return None
    text, level = a.value, None
    if kind == "prompt" and (found := _PROMPT.fullmatch(a.value.strip())):
        level, text = int(found[1]), found[2] or ""
    if kind == "phase":
        label, text = a.value, ""
    drawn = tier.type == MOMENT and round(1000 * (a.end_s - a.start_s)) <= MOMENT_MS
    return Event(
        session=session,
        kind=kind,
        start_s=a.start_s,
        end_s=None if drawn else a.end_s,
        who=tier.participant or (None if kind == "phase" else tier.name.partition("@")[2].partition("@")[0] or None),
        turn_id=turn,
        label=label,
        level=level,
        text=text,
        origin=f"ELAN {origin}",
        origin_id=a.key,
    )
