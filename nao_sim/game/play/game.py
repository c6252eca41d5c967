"""A session from its orientation to its closing, turn by turn, into its folder."""

from __future__ import annotations

import secrets
from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import fields
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from nao_sim.episodes.provenance import versions
from nao_sim.game.play.clock import Clock
from nao_sim.game.play.people import FilmPlayer, Player, players_of
from nao_sim.game.play.phases import closing, orientation, rehearsal
from nao_sim.game.play.robot import RobotPlayer
from nao_sim.game.play.turn import Table, play_turn
from nao_sim.game.play.voice import Say, Voice
from nao_sim.game.session import PlannedTurn, SessionFile, child_targets, plan_turns
from nao_sim.game.store.folder import SessionFolder, check_new
from nao_sim.game.store.keep import keep_phase, keep_start, keep_turn
from nao_sim.game.store.log import Log
from nao_sim.game.store.turn_record import TurnRecord
from nao_sim.game.tables import Session, Tables, Turn
from nao_sim.game.watch.watching import Watcher
from nao_sim.resources import resource
from nao_sim.robot import Nao
from recognizer import Recognizer

Progress = Callable[[str, int, int | None], None]
RULES = "rules"
"""What the journal calls the moment at which the rules were said and the game began."""


def play(
    session: SessionFile,
    out: str | Path,
    *,
    resume: bool = False,
    say: Say | None = None,
    nao: Nao | None = None,
    recognizer: Recognizer | None = None,
    progress: Progress | None = None,
    told: Callable[[Turn], None] = lambda turn: None,
) -> Tables:
    """Play a session, or go on with one that was broken off.

    A kill at any moment loses at most the turn in progress. Ctrl-C stores that turn as aborted; where the session has
    an open end it ends the game, and the closing follows.

    Args:
        session: what was agreed.
        out: the session's folder.
        resume: go on with the session that stands there.
        say: speaks each sentence beside the log, such as a robot's link; None: nobody.
        nao: the robot; None for a new one.
        recognizer: of moving gestures; None for the one that comes with the package.
        progress: called with a stage, how much of it is done, and how much there is (None: not known).
        told: called with each turn when it is over.

    Returns:
        The tables, which are in the folder, too.

    Raises:
        GameError: the folder holds another session, or another run is in it; a camera gives no picture.
        KeyboardInterrupt: Ctrl-C, where an end was agreed; everything is stored.
    """
    folder = SessionFolder(Path(out))
    if resume:
        folder.check_begun()
    else:
        check_new(folder.path)
    with folder.claimed(), ExitStack() as stack:
        if resume:
            session = folder.agreed_again(session)
        else:
            folder.check_empty()
        recognizer = recognizer or Recognizer.load(resource("assets", "databases", "dynamic.parquet"))
        players = players_of(session, recognizer, stack, progress)  # may fail; nothing has begun yet
        if not resume:
            folder.begin(session, _row(session))
        run = _Run(session, folder, recognizer, players, say, nao, progress)
        try:
            run.play(told)
        finally:
            tables = folder.write_tables()
    return tables


def _row(session: SessionFile) -> Session:
    """The row of a session; a drawn order's seed is drawn now if the file has none."""
    seed = None
    if session.order == "drawn":
        seed = secrets.randbelow(2**31) if session.seed is None else session.seed
    ours = {f.name for f in fields(Session)}
    same = {f.name: getattr(session, f.name) for f in fields(session) if f.name in ours}
    packages = versions()
    cells: dict[str, Any] = {
        **same,
        "session": session.name,
        "started": datetime.now(UTC).astimezone().isoformat(timespec="milliseconds"),
        "circle": tuple(f"{person.role}:{person.id}" for person in session.circle),
        "seed": seed,
        "planned": child_targets(session, seed or 0),
        "time_limit_s": None if session.minutes is None else 60 * session.minutes,
        "scale": session.scoring.scale,
        "success_at": session.scoring.success_at,
        "rule": session.scoring.rule,
        "rule_text": session.scoring.text,
        "software": ", ".join(f"{name} {packages[name]}" for name in ("nao-sim", "mujoco") if name in packages),
    }
    return Session(**cells)


class _Run:
    """One run of a session, from where it stands to its end."""

    def __init__(
        self,
        session: SessionFile,
        folder: SessionFolder,
        recognizer: Recognizer,
        players: dict[tuple[str, bool], Player],
        say: Say | None,
        nao: Nao | None,
        progress: Progress | None,
    ) -> None:
        self.session, self.folder, self.done = session, folder, folder.played()
        assert self.done.session is not None
        self.row = self.done.session
        watcher = Watcher(recognizer, session.among)
        clock = Clock(self.done.clock_s, session.live)
        robot = None
        if session.robot is not None:
            robot = RobotPlayer(clock, nao)
            robot.rehearse(rehearsal(session, watcher), progress)
        self.table = Table(session, clock, Voice(session.words, clock, say), watcher, robot, players)
        self.nao = None if robot is None else robot.nao
        keep_start(folder, self.row, self.nao)

    def play(self, told: Callable[[Turn], None]) -> None:
        if "orientation" not in self.done.phases:
            self._phase("orientation", orientation)
        finished = {turn.turn: turn for turn in self.done.turns}
        phase = None
        begun = self.done.phases.get(RULES)
        try:
            for turn in plan_turns(self.session, self.row.seed or 0):
                if begun is not None and self._over(begun):
                    break
                if not self._begin(turn):
                    break
                if turn.number in finished:
                    continue
                if phase != turn.phase:
                    phase = turn.phase
                    if phase == "game" and begun is None:
                        begun = self._say_rules()
                told(self._turn(turn))
        except KeyboardInterrupt:
            if not self.session.open_end:
                raise
        if "closing" not in self.done.phases:
            self._phase("closing", closing)

    def _over(self, begun: float) -> bool:
        """Whether the game's fixed time is over."""
        minutes = self.session.minutes
        return minutes is not None and self.table.clock.now - begun >= 60 * minutes

    def _begin(self, turn: PlannedTurn) -> bool:
        """Go on to this turn's films; False: there are no more, which ends a game without an agreed number of turns."""
        players = [self.table.players.get(key) for key in ((turn.model, False), (turn.imitator, True))]
        wanted: list[Player] = [player for player in players if player is not None]
        if any(isinstance(player, FilmPlayer) and player.over for player in wanted):
            return False
        for player in wanted:
            player.begin()
        return True

    def _say_rules(self) -> float:
        """Say the game's rules; returns when the game has begun."""
        side = "left" if self.session.direction == "clockwise" else "right"
        log = Log(self.session.name)
        self.table.voice.speak(log, "instruction", "rules", self.table.speaker, side=side)
        begun = self.table.clock.now
        self.folder.phase_over(RULES, log.events, begun)
        return begun

    def _phase(self, name: str, play_phase: Callable[[Table, TurnRecord], None]) -> None:
        record = TurnRecord(Log(self.session.name))
        begun = self.table.clock.now
        record.states.append(("1_phase", begun, name))
        play_phase(self.table, record)
        record.states += [(lane, self.table.clock.now, "end") for lane in ("1_phase", "3_doing")]
        record.log.add("phase", begun, self.table.clock.now, label=name)
        keep_phase(self.folder, name, self.row, self.nao, record)
        self.folder.phase_over(name, record.log.events, self.table.clock.now)

    def _turn(self, turn: PlannedTurn) -> Turn:
        record = TurnRecord(Log(self.session.name, f"{self.session.name}/{turn.number}"))
        record.states.append(("1_phase", self.table.clock.now, turn.phase))
        try:
            play_turn(self.table, turn, record)
        except KeyboardInterrupt:
            record.exclude("aborted", "stopped by the keyboard")
            if self.table.robot is not None:
                self.table.robot.stand()
            self._keep(turn, record)
            raise
        return self._keep(turn, record)

    def _keep(self, turn: PlannedTurn, record: TurnRecord) -> Turn:
        return keep_turn(self.folder, self.session, self.row, turn, self.nao, record, self.table.clock.now)
