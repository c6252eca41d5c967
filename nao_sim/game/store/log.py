"""The events of one turn or phase while it is played."""

from __future__ import annotations

from dataclasses import dataclass, field

from nao_sim.game.tables import Event


@dataclass
class Log:
    """Collects events.

    Attributes:
        session: the session's name.
        turn_id: the turn they belong to; None: none.
        events: in the order in which they were added.
    """

    session: str
    turn_id: str | None = None
    events: list[Event] = field(default_factory=list)

    def add(
        self,
        kind: str,
        start_s: float,
        end_s: float | None = None,
        *,
        who: str | None = None,
        label: str | None = None,
        level: int | None = None,
        text: str = "",
    ) -> None:
        """Write an event down; columns as in :class:`nao_sim.game.tables.Event`."""
        end = None if end_s is None else round(end_s, 4)
        self.events.append(Event(self.session, kind, round(start_s, 4), end, who, self.turn_id, label, level, text))
