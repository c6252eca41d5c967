"""A session's folder: one journal that is the truth, a folder a turn, and the tables made from the journal.

::

    DIR/session.toml    what was agreed, as it was when the session began
    DIR/journal.jsonl   the session, every phase and every finished turn, on the disk before the next begins
    DIR/turns/007/      what was seen and done in turn 7: turn.json, turn.rrd, robot.parquet, films of camera and actor
    DIR/turns.csv …     the tidy tables (docs/turns.md)
    DIR/ratings/R2.jsonl  what a rater said, likewise only growing
"""

from __future__ import annotations

import fcntl
import hashlib
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import asdict, dataclass, fields, replace
from pathlib import Path
from typing import Any

from nao_sim.episodes.folder import check_place
from nao_sim.game.errors import GameError
from nao_sim.game.session import SessionFile, read_session
from nao_sim.game.store import journal
from nao_sim.game.tables import Event, Rating, Session, Tables, Turn, write_tables

JOURNAL, AGREED, TURNS, RATINGS, LOCK = "journal.jsonl", "session.toml", "turns", "ratings", ".lock"


@dataclass
class Played:
    """What the journal says.

    Attributes:
        session: the row of the session; None: not begun.
        turns: finished turns.
        events: all events.
        phases: phases that are over, and when.
        clock_s: how far the session's time has come.
        files: the folder that films are relative to.
        among: what the recogniser decides between; None: all it knows.
    """

    session: Session | None
    turns: list[Turn]
    events: list[Event]
    phases: dict[str, float]
    clock_s: float
    files: Path | None
    among: tuple[str, ...] | None = None


class SessionFolder:
    """The folder of one session.

    Args:
        path: where it stands or shall stand.
    """

    def __init__(self, path: Path) -> None:
        self.path = path

    @contextmanager
    def claimed(self) -> Iterator[None]:
        """Keep every other run out of the folder; a run that was killed keeps nobody out.

        Raises:
            GameError: another run is in it.
        """
        self.path.mkdir(parents=True, exist_ok=True)
        with (self.path / LOCK).open("w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                raise GameError(
                    f"another run is playing or scoring in {self.path}; wait for its end or choose another --out"
                ) from None
            yield

    @property
    def begun(self) -> bool:
        """Whether a session has begun here."""
        return bool(journal.read(self.path / JOURNAL))

    def check_begun(self) -> None:
        """Refuse a folder in which no session has begun.

        Raises:
            GameError: no session stands here.
        """
        if not self.begun:
            raise GameError(f"{self.path} holds no session; begin one with nao-sim game SESSION.toml --out {self.path}")

    def check_empty(self) -> None:
        """Refuse a folder in which a session has begun.

        Raises:
            GameError: a session stands here already.
        """
        if self.begun:
            raise GameError(f"{self.path} holds a session already; go on with --resume or choose another --out")

    def begin(self, session: SessionFile, row: Session) -> None:
        """Start a session; see :meth:`check_empty`."""
        shutil.copyfile(session.path, self.path / AGREED)
        files = str(session.path.parent.absolute())
        self._append({"session": asdict(row), "files": files, "among": session.among})

    def agreed_again(self, session: SessionFile) -> SessionFile:
        """Return the session begun here, for going on with it; another session file than the one begun with is refused.

        Raises:
            GameError: the files differ, or no session has begun here.
        """
        begun = self.agreed()
        if _sha256(session.path) != _sha256(begun.path):
            raise GameError(
                f"{session.path} differs from {begun.path}, with which the session began; "
                "go on with --resume and without a file, or begin anew with another --out"
            )
        return begun

    def agreed(self) -> SessionFile:
        """Return the session file that was begun with; films stay where they were.

        Raises:
            GameError: no session has begun here.
        """
        self.check_begun()
        played = self.played()
        assert played.files is not None
        return replace(read_session(self.path / AGREED, played.files), among=played.among)

    def phase_over(self, phase: str, events: list[Event], clock_s: float) -> None:
        """Write down that a phase is over."""
        self._append({"phase": phase, "events": [asdict(event) for event in events], "clock_s": clock_s})

    def turn_over(self, turn: Turn, events: list[Event], clock_s: float) -> None:
        """Write down a finished turn; from here on a kill cannot lose it."""
        self.sync(self.turn_folder(turn.turn))
        self._append({"turn": asdict(turn), "events": [asdict(event) for event in events], "clock_s": clock_s})

    def turn_folder(self, number: int) -> Path:
        """Return the folder of a turn."""
        return self.path / TURNS / f"{number:03d}"

    @staticmethod
    def sync(folder: Path) -> None:
        """Wait until the disk has a folder and its files."""
        for file in folder.glob("*"):
            with file.open("rb") as handle:
                os.fsync(handle.fileno())
        journal.sync_folder(folder)
        journal.sync_folder(folder.parent)

    def _append(self, record: dict[str, Any]) -> None:
        journal.append(self.path / JOURNAL, record)

    def played(self) -> Played:
        """Return what the journal says.

        Raises:
            GameError: the journal is damaged.
        """
        found = Played(None, [], [], {}, 0.0, None)
        for record in journal.read(self.path / JOURNAL):
            found.events += [_row(Event, event) for event in record.get("events", [])]
            found.clock_s = record.get("clock_s", found.clock_s)
            if "session" in record:
                found.session, found.files = _row(Session, record["session"]), Path(record["files"])
                found.among = None if record["among"] is None else tuple(record["among"])
            if "turn" in record:
                found.turns.append(_row(Turn, record["turn"]))
            if "phase" in record:
                found.phases[record["phase"]] = record["clock_s"]
        return found

    def ratings(self) -> tuple[Rating, ...]:
        """Return everybody's ratings, each rater's in the order given."""
        files = sorted((self.path / RATINGS).glob("*.jsonl"))
        return tuple(_row(Rating, record) for file in files for record in journal.read(file))

    def rate(self, rating: Rating) -> None:
        """Write a rating down beside all others."""
        (self.path / RATINGS).mkdir(exist_ok=True)
        journal.append(self.path / RATINGS / f"{rating.rater}.jsonl", asdict(rating))

    def write_tables(self) -> Tables:
        """Make the tables anew from the journal and the ratings of a session that has begun."""
        played = self.played()
        assert played.session is not None, "see check_begun"
        row = replace(played.session, duration_s=played.clock_s) if "closing" in played.phases else played.session
        events = (*played.events, *_turn_phases(played))
        tables = Tables((row,), tuple(played.turns), self.ratings(), events)
        write_tables(self.path, tables)
        return tables


def _turn_phases(played: Played) -> list[Event]:
    """When the phases began and ended that consist of turns: from their first event to their last."""
    made = []
    for phase in dict.fromkeys(turn.phase for turn in played.turns):
        keys = {turn.turn_id for turn in played.turns if turn.phase == phase}
        times = [t for e in played.events if e.turn_id in keys for t in (e.start_s, e.end_s) if t is not None]
        if times and played.session is not None:
            made.append(Event(played.session.session, "phase", min(times), max(times), label=phase))
    return made


def check_new(path: Path) -> None:
    """Say before anything is done that a session cannot be kept there.

    Raises:
        EpisodeError: the place holds other files or cannot be written.
    """
    if not (path / LOCK).exists():
        check_place(path, JOURNAL)


def _row(kind: type, cells: dict[str, Any]) -> Any:
    """Make a row of what JSON kept of it; JSON has no tuples."""
    known = {f.name for f in fields(kind)}
    return kind(**{key: tuple(v) if isinstance(v, list) else v for key, v in cells.items() if key in known})


def _sha256(path: Path) -> str:
    return hashlib.sha256(path.read_bytes()).hexdigest()
