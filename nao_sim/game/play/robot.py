"""The robot's part: every gesture in play is ready before the first turn, so that an answer starts at once."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable

import numpy as np

from nao_sim.episodes.episode import Answer
from nao_sim.episodes.imitate import gesture_of
from nao_sim.game.play.clock import Clock
from nao_sim.game.store.turn_record import Done
from nao_sim.gestures import Prepared, find_gesture, prepare
from nao_sim.gestures.act import at_home, come_home, setpoint_of
from nao_sim.motion import Trajectory, perform
from nao_sim.robot import Nao

Progress = Callable[[str, int, int | None], None]

STRAYED_M = 0.05
"""Further than this from where it stood, the robot is put back between turns."""


class RobotPlayer:
    """One simulated NAO over a whole session.

    Args:
        clock: the session's time; in a live session motions are shown in real time.
        nao: the robot; None for a new one of the thesis's limits.
    """

    def __init__(self, clock: Clock, nao: Nao | None = None) -> None:
        self.nao = nao or Nao()
        self._clock = clock
        self._ready: dict[Answer, Prepared] = {}
        self.stand()

    def rehearse(self, answers: Iterable[Answer], progress: Progress | None = None) -> None:
        """Work out motions beforehand; the first time takes up to a second each, for the legs that they need."""
        wanted = [answer for answer in dict.fromkeys(answers) if answer.gesture is not None]
        for number, answer in enumerate(wanted, 1):
            self._prepared(answer)
            if progress is not None:
                progress("Rehearsing", number, len(wanted))

    def _prepared(self, answer: Answer) -> Prepared:
        gesture = gesture_of(answer)
        if gesture is None:
            return Prepared(Trajectory(np.zeros(1), self.nao.setpoint[None]), [])
        if answer not in self._ready:
            self._ready[answer] = prepare(gesture, limits=self.nao.limits)
        start = setpoint_of(self.nao)
        return self._ready[answer] if at_home(start) else prepare(gesture, start, limits=self.nao.limits)

    def stand(self) -> None:
        """Put the robot upright where it belongs, its weight on its feet."""
        self.nao.reset("StandInit")
        self.nao.step(round(0.5 / self.nao.control_period))
        self._place = self.nao.torso_pose[:2]

    def perform(self, answer: Answer) -> Done:
        """Make a gesture from where the robot is; only from standing is it ready at once.

        A robot that has fallen or strayed is stood up first.
        """
        if self.nao.fallen or np.hypot(*(self.nao.torso_pose[:2] - self._place)) > STRAYED_M:
            self.stand()
        trajectory = self._prepared(answer).trajectory
        start, began = self._clock.now, 0.0

        def step(done: int, _: int) -> None:
            nonlocal began
            if done == 1:
                began = time.perf_counter()
            if self._clock.live:
                self._clock.until(start + done * self.nao.control_period)

        log = perform(self.nao, trajectory, progress=step)
        self._clock.until(start + float(log.time[-1]))
        return Done(start, log, began)

    def game_gesture(self, name: str) -> Done:
        """Make a gesture of the library's game family, such as ``congratulate``."""
        return self.perform(Answer(find_gesture(name).name, False))

    def come_home(self) -> Done | None:
        """Bring every joint back to standing; None if they are there."""
        if self.nao.fallen:
            self.stand()
            return None
        start = self._clock.now
        log = come_home(self.nao)
        if log is None:
            return None
        self._clock.until(start + float(log.time[-1]))
        return Done(start, log, time.perf_counter())
