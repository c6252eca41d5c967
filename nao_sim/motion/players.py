"""What a crowd of robots can play: a trajectory or a walk, each with its own feedback, one row a robot."""

from __future__ import annotations

from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.balance import Balance, Gains, planned_lean
from nao_sim.motion.perform import LEAD_S, SETTLE_S
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.motion.walking import Observation, WalkController, WalkPlan

Array = NDArray[np.float64]
Motion = Trajectory | WalkPlan


class Player(Protocol):
    """A motion with its feedback.

    Attributes:
        planned: targets without feedback at the beginning and after each control period, rad, shape (steps + 1, 25).
        leans: the torso's roll and pitch that they mean, rad, shape (steps + 1, 2).
    """

    planned: Array
    leans: Array

    def commands(self, step: int, lean: Array, rate: Array) -> Array:
        """Return the set-points of all robots, rad, shape (n, 25), from their lean and its rate, shape (n, 2)."""
        ...


class TrajectoryPlayer:
    """A trajectory, as :func:`nao_sim.motion.perform.perform` plays it."""

    def __init__(self, trajectory: Trajectory, count: int, balance: bool, gains: Gains | None) -> None:
        steps = int(np.ceil((trajectory.duration + SETTLE_S) / CONTROL_PERIOD - 1e-9))
        start = trajectory.times[0]
        self.planned = trajectory.sample(start + np.arange(steps + 1) * CONTROL_PERIOD)
        self._ahead = trajectory.sample(start + np.arange(1, steps + 1) * CONTROL_PERIOD + LEAD_S)
        self.leans = planned_lean(self.planned)
        self._feedback = Balance(count, gains) if balance else None

    def commands(self, step: int, lean: Array, rate: Array) -> Array:
        """Return the set-points; see :class:`Player`."""
        wanted = np.repeat(self._ahead[step][None], len(lean), axis=0)
        if self._feedback is not None:
            wanted += self._feedback.correct(lean, rate, self.leans[step])
        return wanted


class WalkPlayer:
    """A walk, as :func:`nao_sim.motion.walking.walk` plays it."""

    def __init__(self, plan: WalkPlan) -> None:
        steps = len(plan.times) + round(SETTLE_S / CONTROL_PERIOD)
        self.planned = plan.targets[np.minimum(np.arange(steps + 1), len(plan.times) - 1)]
        # The plan keeps the torso at one lean.
        self.leans = np.tile([0.0, plan.lean_rad], (steps + 1, 1))
        self._controller = WalkController(plan)

    def commands(self, step: int, lean: Array, rate: Array) -> Array:
        """Return the set-points; see :class:`Player`."""
        return self._controller.targets(Observation(lean, rate))


def player_of(motion: Motion, count: int, balance: bool = True, gains: Gains | None = None) -> Player:
    """Return the player of a motion for so many robots."""
    if isinstance(motion, WalkPlan):
        return WalkPlayer(motion)
    return TrajectoryPlayer(motion, count, balance, gains)
