"""Play a trajectory on the robot: a set-point every 20 ms, balance feedback, and a log of what the body did."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.balance import Balance, lean_of, planned_lean
from nao_sim.motion.trajectory import Trajectory
from nao_sim.robot import ACTUATED, Nao, joint_table

Progress = Callable[[int, int], None]
Array = NDArray[np.float64]

SETTLE_S = 0.5
# Motor boards interpolate towards a set-point during the period after it came, and the motors follow a little later;
# sent so much early, the joints are where the trajectory has them at its own time.
LEAD_S = 0.02


@dataclass(frozen=True, eq=False)
class MotionLog:
    """What was asked and what happened, every 20 ms; m moments.

    Attributes:
        time: seconds from the start of the motion, shape (m,); the first moment is before the first set-point.
        targets: the trajectory's set-points, rad (hands fraction), shape (m, 25), columns as ``names``.
        commands: what was sent: the targets with the balance feedback, shape (m, 25).
        angles, velocities, torques: measured, rad, rad/s, Nm, shape (m, 25).
        torso_pose: position m and orientation w, x, y, z in the world, shape (m, 7).
        body_pose: the same of every body of the model, shape (m, nbody, 7).
        contacts: foot force sensors, N, shape (m, 8), order of :data:`nao_sim.robot.sensors.FSR`.
        fallen: down at the end or on the way; who lies from the beginning is.
        fell_at: seconds, or None.
        names: columns.
    """

    time: Array
    targets: Array
    commands: Array
    angles: Array
    velocities: Array
    torques: Array
    torso_pose: Array
    body_pose: Array
    contacts: Array
    fallen: bool
    fell_at: float | None
    names: tuple[str, ...] = ACTUATED


class Recorder:
    """Collects one row of a :class:`MotionLog` a control period.

    Args:
        nao: the robot; time counts from now.
    """

    def __init__(self, nao: Nao) -> None:
        self.nao = nao
        self.rows: list[tuple[Array, ...]] = []
        self.start = nao.time
        self.fell_at: float | None = None

    def add(self, targets: Array, commands: Array) -> None:
        """Take down this moment: what was meant and what was sent, rad, shape (25,), and what the body does."""
        nao = self.nao
        if self.fell_at is None and (nao.fallen or nao.lies):
            self.fell_at = nao.time - self.start
        bodies = np.concatenate([nao.data.xpos, nao.data.xquat], axis=1)
        moment = np.array(nao.time - self.start)
        self.rows.append(
            (moment, targets, commands, nao.angles, nao.velocities, nao.torques, nao.torso_pose, bodies, nao.fsr)
        )

    def log(self) -> MotionLog:
        """Return what was collected."""
        names = [entry.name for entry in fields(MotionLog)]
        columns: dict[str, Any] = {
            name: np.array(column) for name, column in zip(names, zip(*self.rows, strict=True), strict=False)
        }
        return MotionLog(**columns, fallen=self.fell_at is not None, fell_at=self.fell_at)


def perform(
    nao: Nao,
    trajectory: Trajectory,
    *,
    balance: bool = True,
    progress: Progress | None = None,
    settle_s: float = SETTLE_S,
) -> MotionLog:
    """Play a trajectory from where the robot is, and then hold its end for a moment.

    Args:
        nao: the robot; the motion starts from its present state.
        trajectory: what to do.
        balance: with the on-line feedback of :class:`nao_sim.motion.balance.Balance`.
        progress: called with (periods done, periods in all) after each control period.
        settle_s: seconds to hold the last target, so that a fall at the end is seen.

    Returns:
        The log; a fall is in it, and the motion is played to its end all the same.

    Raises:
        RobotError: a target outside its range, or an unstable simulation.
    """
    period = nao.control_period
    steps = int(np.ceil((trajectory.duration + settle_s) / period - 1e-9))
    plan = trajectory.sample(trajectory.times[0] + np.arange(steps + 1) * period)
    ahead = trajectory.sample(trajectory.times[0] + np.arange(1, steps + 1) * period + LEAD_S)
    leans = planned_lean(plan)
    low, high = joint_table().select(ACTUATED).range_rad(nao.limits).T
    feedback = Balance()
    recorder = Recorder(nao)
    recorder.add(plan[0], nao.setpoint)
    for step in range(steps):
        command = ahead[step]
        if balance:
            lean = lean_of(nao.torso_pose[None, 3:])
            command = np.clip(command + feedback.correct(lean, nao.gyro[None, :2], leans[step])[0], low, high)
        nao.set_targets(command)
        nao.step()
        recorder.add(plan[step + 1], nao.setpoint)
        if progress is not None:
            progress(step + 1, steps)
    return recorder.log()
