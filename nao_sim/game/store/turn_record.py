"""What happened in one turn while it is played: what becomes its row, and what becomes its recording."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from nao_sim.game.session import Cut
from nao_sim.game.store.log import Log
from nao_sim.game.watch.watching import Watched
from nao_sim.motion import MotionLog


@dataclass(frozen=True)
class Done:
    """A motion in the session.

    Attributes:
        start_s: when it began, seconds of the session.
        log: what the body did.
        began: ``time.perf_counter()`` of the first command.
    """

    start_s: float
    log: MotionLog
    began: float

    @property
    def end_s(self) -> float:
        """When it ended, seconds of the session."""
        return self.start_s + float(self.log.time[-1])


@dataclass(frozen=True)
class Shown:
    """A film that somebody is seen on.

    Attributes:
        who: pseudonym.
        start_s: when it began, seconds of the session.
        watched: what it showed.
        answering: whether they imitate; otherwise they model.
        cut: the own film that it is a piece of; None: it is kept in the turn's folder.
        attempt: number of the attempt, from 0.
    """

    who: str
    start_s: float
    watched: Watched
    answering: bool
    cut: Cut | None
    attempt: int

    @property
    def end_s(self) -> float:
        """When it ended, seconds of the session."""
        return self.start_s + self.watched.seconds


@dataclass
class TurnRecord:
    """Grows while a turn is played.

    Attributes:
        log: its events.
        row: columns of :class:`nao_sim.game.tables.Turn` as they become known.
        films: what was seen.
        motions: what the robot did.
        states: (lane, seconds of the session, word) for the time line.
        notes: (seconds of the session, Markdown) for the text panel.
    """

    log: Log
    row: dict[str, Any] = field(default_factory=dict)
    films: list[Shown] = field(default_factory=list)
    motions: list[Done] = field(default_factory=list)
    states: list[tuple[str, float, str]] = field(default_factory=list)
    notes: list[tuple[float, str]] = field(default_factory=list)

    def exclude(self, reason: str, note: str = "") -> None:
        """Call the turn no trial; the first reason stays."""
        self.row.setdefault("excluded", reason)
        self.row.setdefault("excluded_note", note)

    @property
    def begun_s(self) -> float:
        """When it began, seconds of the session."""
        return self.states[0][1] if self.states else 0.0

    @property
    def excluded(self) -> bool:
        """Whether the turn is no trial."""
        return self.row.get("excluded") is not None

    def say(self, note: str) -> None:
        """Add to the turn's note."""
        self.row["note"] = "; ".join(part for part in (self.row.get("note", ""), note) if part)
