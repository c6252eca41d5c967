"""Get up after a fall, on the robot's own arms and legs."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.balance import lean_of
from nao_sim.motion.getting_up.key_frames import GOAL, get_up_trajectory
from nao_sim.motion.getting_up.lying import Lie, lie_of
from nao_sim.motion.perform import MotionLog, Progress, Recorder
from nao_sim.robot import ACTUATED, Nao, joint_table
from nao_sim.robot.postures import posture

ATTEMPTS = 2
REST_S = 0.6  # before each attempt: what fell comes to rest
HOLD_S = 1.0  # after it: whether it stands is seen
HOMING_S = 1.5  # from any upright posture to StandInit
STANDING_RAD = float(np.deg2rad(15.0))
STANDING_HEIGHT_M = 0.245  # of the torso above the lower ankle; 0.275 in StandInit


def get_up(nao: Nao, *, progress: Progress | None = None) -> MotionLog:
    """Get up from belly or back and stand in StandInit; a second attempt follows a first that failed.

    Which motion it takes is told by the torso's orientation. An upright robot goes to StandInit; should it fall on the
    way, because it knelt or sat, it gets up from there. From the back the hips fold to 104 degrees, which the thesis's
    limits allow and those of NAO V5 do not: with ``limits="v5"`` the robot stays on its back.

    Args:
        nao: the robot, in any state.
        progress: called with (periods done, periods in all so far planned) after each control period.

    Returns:
        The log of all attempts. ``fallen`` tells whether the robot lies at the end, not that it lay at the beginning.

    Raises:
        RobotError: the simulation became unstable.
    """
    player = _Player(nao, progress)
    attempts = homings = 0
    while attempts < ATTEMPTS and homings < ATTEMPTS:
        player.hold(nao.setpoint, REST_S)
        lie = lie_of(nao.torso_pose[3:])
        if lie is Lie.UPRIGHT:
            player.home()
            homings += 1
        else:
            player.play(get_up_trajectory(lie, nao.setpoint).targets)
            attempts += 1
        player.hold(_stance(), HOLD_S)
        if stands(nao):
            break
    log = player.recorder.log()
    return replace(log, fallen=not stands(nao), fell_at=None if stands(nao) else float(log.time[-1]))


def stands(nao: Nao) -> bool:
    """Return whether the torso is as high and as upright as in StandInit, with nothing but the feet on the floor."""
    roll, pitch = lean_of(nao.torso_pose[None, 3:])[0]
    upright = abs(roll) < STANDING_RAD and abs(pitch) < STANDING_RAD
    ankles = min(nao.data.xpos[nao.wiring.body(name), 2] for name in ("l_foot", "r_foot"))
    return bool(upright and nao.torso_pose[2] - ankles > STANDING_HEIGHT_M and not nao.fallen)


def _stance() -> NDArray[np.float64]:
    return np.array([posture(GOAL)[name] for name in ACTUATED])


class _Player:
    """Sends targets, records, reports progress."""

    def __init__(self, nao: Nao, progress: Progress | None) -> None:
        self.nao, self.progress = nao, progress
        self.recorder = Recorder(nao)
        self.recorder.add(nao.setpoint, nao.setpoint)
        self.low, self.high = joint_table().select(ACTUATED).range_rad(nao.limits).T
        self.done = self.planned = 0

    def play(self, targets: NDArray[np.float64]) -> None:
        """Send targets, rad, shape (n, 25), one each control period."""
        self.planned += len(targets)
        for target in targets:
            self._send(np.clip(target, self.low, self.high))

    def hold(self, target: NDArray[np.float64], seconds: float) -> None:
        """Hold a target."""
        self.play(np.repeat(target[None], round(seconds / self.nao.control_period), axis=0))

    def home(self) -> None:
        """Go to StandInit from an upright posture."""
        share = np.linspace(0, 1, round(HOMING_S / self.nao.control_period))[:, None]
        eased = share**2 * (3 - 2 * share)
        self.play(self.nao.setpoint + eased * (_stance() - self.nao.setpoint))

    def _send(self, target: NDArray[np.float64]) -> None:
        self.nao.set_targets(target)
        self.nao.step()
        self.recorder.add(target, self.nao.setpoint)
        self.done += 1
        if self.progress is not None:
            self.progress(self.done, self.planned)
