"""Everything else that has a time: phases, every single prompt, what was said, marks, pauses, faults."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.tables.column import column
from nao_sim.game.tables.words import EVENT_KINDS


@dataclass(frozen=True)
class Event:
    """One row of ``events``."""

    session: str = column("the session it belongs to")
    kind: str = column("what kind of event", words=EVENT_KINDS)
    start_s: float = column("when it began, seconds from the session's start", unit="s")
    end_s: float | None = column("when it ended; none: a moment without length", unit="s", default=None)
    who: str | None = column("pseudonym of who did or said it", default=None)
    turn_id: str | None = column("the turn it belongs to; none: none", default=None)
    label: str | None = column(
        "phase: its name; model, movement: the gesture; speech: initiation, answer or other", default=None
    )
    level: int | None = column("of a prompt: 1 verbal, 2 model again, 3 partial help, 4 full help", default=None)
    text: str = column("what was said, or what went wrong, in words", default="")
    origin: str = column("what wrote it: game, or the tool and tier it was imported from", default="game")
    origin_id: str | None = column("its key there", default=None)
