"""Walk on the robot: plan, then a corrected set-point every 20 ms, and a log."""

from __future__ import annotations

import math

import numpy as np

from nao_sim.motion.errors import MotionError
from nao_sim.motion.perform import MotionLog, Progress, Recorder
from nao_sim.motion.walking.controller import Observation, WalkController
from nao_sim.motion.walking.gait import WalkSettings
from nao_sim.motion.walking.plan import plan_walk
from nao_sim.robot import Nao
from nao_sim.robot.sensors import roll_pitch_yaw

SETTLE_S = 0.5
MOST_M, MOST_RAD = 5.0, 4 * np.pi


def walk(
    nao: Nao,
    x: float = 0.0,
    y: float = 0.0,
    turn: float = 0.0,
    *,
    settings: WalkSettings | None = None,
    progress: Progress | None = None,
    settle_s: float = SETTLE_S,
) -> MotionLog:
    """Walk to a place and stop there in StandInit, with feedback from the inertial unit.

    The robot must stand in StandInit. It knows where it is by its own steps only, as the real one does, so slipping
    shows as a distance to the goal.

    Args:
        nao: the robot; walking starts from its present state.
        x: forward, m, in the robot's frame at the start.
        y: to the robot's own left, m.
        turn: heading at the end, to the left, rad.
        settings: gait and gains; None for ``assets/motions/walk.toml``.
        progress: called with (periods done, periods in all) after each control period.
        settle_s: seconds to keep standing at the end, so that a fall at the end is seen.

    Returns:
        The log; ``targets`` are the plan with its corrections. A fall is in it, and the plan is played to its end.

    Raises:
        MotionError: a displacement that is not finite or further than 5 m or two turns.
        RobotError: the simulation became unstable.
    """
    if not all(map(math.isfinite, (x, y, turn))) or math.hypot(x, y) > MOST_M or abs(turn) > MOST_RAD:
        raise MotionError(f"a walk of ({x}, {y}) m turning {turn} rad; ask for at most {MOST_M:g} m and two turns")
    plan = plan_walk(x, y, turn, settings)
    controller = WalkController(plan, settings)
    recorder = Recorder(nao)
    recorder.add(plan.targets[0], nao.setpoint)
    steps = len(plan.times) + round(settle_s / nao.control_period)
    for step in range(steps):
        targets = controller.targets(observe(nao))
        nao.set_targets(targets)
        nao.step()
        recorder.add(targets, nao.setpoint)
        if progress is not None:
            progress(step + 1, steps)
    return recorder.log()


def observe(nao: Nao) -> Observation:
    """Return what the inertial unit feels now."""
    return Observation(roll_pitch_yaw(nao.torso_pose[3:])[:2], nao.gyro[:2])
