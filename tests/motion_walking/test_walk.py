"""Walking on the simulated robot: it arrives, it stays up, its motors can do it."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.motion import MotionError, MotionLog
from nao_sim.motion.crowd import Crowd
from nao_sim.motion.trials import draw_trials
from nao_sim.motion.walking import Observation, WalkController, observe, plan_walk, walk
from nao_sim.robot import ACTUATED, Nao, joint_table
from nao_sim.robot.postures import posture
from nao_sim.robot.sensors import roll_pitch_yaw

GOALS = {
    "left": (0.0, 0.35, 0.0),
    "right": (0.0, -0.35, 0.0),
    "forward": (0.2, 0.0, 0.0),
    "backward": (-0.2, 0.0, 0.0),
    "turn": (0.0, 0.0, np.pi / 3),
    "arc": (0.15, 0.05, -0.4),
}
# Odometry is all the robot has: a step may slip by a millimetre or two.
TOLERANCE_M, TOLERANCE_RAD = 0.02, 0.04


@pytest.fixture(scope="module")
def walks() -> dict[str, MotionLog]:
    return {name: walk(Nao(fingers=False), *goal) for name, goal in GOALS.items()}


@pytest.mark.parametrize("name", GOALS)
def test_it_arrives_on_its_feet(walks: dict[str, MotionLog], name: str) -> None:
    log, (x, y, turn) = walks[name], GOALS[name]
    assert not log.fallen
    assert log.fell_at is None
    # A turn is about the point between the feet, and the torso is not above it.
    with Nao(fingers=False) as nao:
        ahead = -(nao.data.site("l_sole").xpos + nao.data.site("r_sole").xpos)[0] / 2
    moved = log.torso_pose[-1, :2] - log.torso_pose[0, :2]
    expected = [x + ahead * (np.cos(turn) - 1), y + ahead * np.sin(turn)]
    np.testing.assert_allclose(moved, expected, atol=TOLERANCE_M)
    assert roll_pitch_yaw(log.torso_pose[-1, 3:])[2] == pytest.approx(turn, abs=TOLERANCE_RAD)


def test_sideways_is_at_least_thirty_centimetres_both_ways(walks: dict[str, MotionLog]) -> None:
    moved = {name: log.torso_pose[-1, 1] - log.torso_pose[0, 1] for name, log in walks.items()}
    assert moved["left"] > 0.30
    assert moved["right"] < -0.30


@pytest.mark.parametrize("name", GOALS)
def test_motors_can_do_it(walks: dict[str, MotionLog], name: str) -> None:
    log, table = walks[name], joint_table().select(ACTUATED)
    low, high = table.range_rad("envelope").T
    stance = np.array([posture("StandInit")[joint] for joint in ACTUATED])
    assert ((log.targets >= np.minimum(low, stance)) & (log.targets <= np.maximum(high, stance))).all()
    assert (np.abs(np.diff(log.targets, axis=0)) / 0.02 <= table.max_speed_rad()).all()
    assert (np.abs(log.torques) <= table.torque_limit_nm() + 1e-6).all()
    rms_deg = np.rad2deg(np.sqrt(np.mean((log.angles - log.targets) ** 2, axis=0)))
    assert rms_deg.max() < 5.0


@pytest.mark.parametrize("name", ["left", "forward"])
def test_it_takes_real_steps(walks: dict[str, MotionLog], name: str) -> None:
    contacts = walks[name].contacts
    for foot in (slice(0, 4), slice(4, 8)):
        in_the_air = contacts[:, foot].sum(axis=1) == 0
        lifts = np.flatnonzero(np.diff(in_the_air.astype(int)) == 1)
        assert len(lifts) >= 3
    assert (contacts.sum(axis=1) > 0).mean() > 0.98


def test_it_ends_in_stand_init(walks: dict[str, MotionLog]) -> None:
    stance = np.array([posture("StandInit")[joint] for joint in ACTUATED])
    for log in walks.values():
        assert np.rad2deg(np.abs(log.angles[-1] - stance)).max() < 3.0


def test_nothing_but_the_floor_holds_the_robot() -> None:
    nao = Nao(fingers=False)
    controller = WalkController(plan_walk(0.0, 0.05, 0.0))
    while not controller.done:
        nao.set_targets(controller.targets(observe(nao)))
        nao.step()
        assert not nao.data.xfrc_applied.any()
        assert not nao.data.qfrc_applied.any()
    assert nao.model.nmocap == 0


def test_feedback_pushes_against_a_lean() -> None:
    controller = WalkController(plan_walk(0.0, 0.05, 0.0))
    still = Observation(np.array([0.0, controller.plan.lean_rad]), np.zeros(2))
    np.testing.assert_allclose(controller.targets(still), controller.plan.targets[0], atol=1e-6)
    ahead = controller.targets(Observation(still.lean + 0.1, np.zeros(2))) - controller.plan.targets[1]
    changed = {name for name, change in zip(ACTUATED, ahead, strict=True) if change > 1e-3}
    assert changed == {"LAnklePitch", "RAnklePitch", "LAnkleRoll", "RAnkleRoll"}


def test_a_batch_is_driven_as_its_members() -> None:
    plan = plan_walk(0.0, 0.05, 0.0)
    rng = np.random.default_rng(5)
    batch, alone = WalkController(plan), WalkController(plan)
    for _ in range(40):
        lean, gyro = rng.normal(0, 0.05, (2, 6, 2))
        together = batch.targets(Observation(lean, gyro))
        assert together.shape == (6, 25)
        np.testing.assert_array_equal(together[4], alone.targets(Observation(lean[4], gyro[4])))


def test_it_stays_up_when_robot_and_floor_are_not_as_documented() -> None:
    # All factors of the stress test at once; benchmarks/walking.py has the figures for many trials.
    trials = draw_trials(11, range(16), Nao(fingers=False).model.nbody)
    crowd = Crowd(trials)
    controller = WalkController(plan_walk(0.0, 0.14, 0.0))
    steps = len(controller.plan.times) + 25
    up = np.ones(len(trials), bool)
    for step in range(steps):
        crowd.push(step / steps, steps * 0.02)
        crowd.step(controller.targets(Observation(crowd.lean(), crowd.rate())))
        up &= ~crowd.down()
    assert up.sum() >= 15


@pytest.mark.parametrize("goal", [(np.nan, 0.0, 0.0), (0.0, 50.0, 0.0), (0.0, 0.0, 100.0)])
def test_a_senseless_goal_is_refused(goal: tuple[float, float, float]) -> None:
    with pytest.raises(MotionError, match="walk of"):
        walk(Nao(fingers=False), *goal)


def test_progress_is_told() -> None:
    told: list[tuple[int, int]] = []
    log = walk(Nao(fingers=False), 0.0, 0.02, progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (len(log.time) - 1, len(log.time) - 1)
    assert [done for done, _ in told] == list(range(1, len(log.time)))
