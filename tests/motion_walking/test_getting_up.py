"""Getting up from belly and back on the simulated robot."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from nao_sim.motion import MotionError, check
from nao_sim.motion.getting_up import Lie, get_up, get_up_trajectory, lie_of
from nao_sim.robot import ACTUATED, Nao, joint_table
from nao_sim.robot.postures import posture

SIDES = (Lie.BELLY, Lie.BACK)
STANCE = np.array([posture("StandInit")[joint] for joint in ACTUATED])


def lying(side: Lie, friction: float = 0.8, mass: float = 1.0, heading: float = 0.0) -> Nao:
    """Return a robot that was dropped on its belly or back from a hand's breadth, joints as in StandInit."""
    nao = Nao(fingers=False)
    nao.model.geom_friction[:, 0] = friction
    nao.model.body_mass[:] *= mass
    nao.model.body_inertia[:] *= mass
    mujoco.mj_setConst(nao.model, nao.data)
    nao.reset()
    pitch = np.pi / 2 if side is Lie.BELLY else -np.pi / 2
    nao.data.qpos[:3] = [0, 0, 0.15]
    nao.data.qpos[3:7] = Rotation.from_euler("ZY", [heading, pitch]).as_quat(scalar_first=True)
    mujoco.mj_forward(nao.model, nao.data)
    nao.step(60)
    return nao


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(("friction", "mass"), [(0.8, 1.0), (0.5, 1.05), (1.0, 0.95)])
def test_it_stands_up(side: Lie, friction: float, mass: float) -> None:
    nao = lying(side, friction, mass, heading=1.0)
    assert lie_of(nao.torso_pose[3:]) is side
    log = get_up(nao)
    assert not log.fallen
    assert log.fell_at is None
    assert not nao.fallen
    assert nao.torso_pose[2] == pytest.approx(0.320, abs=0.01)
    assert np.rad2deg(np.abs(nao.angles - STANCE)).max() < 3.0
    assert not nao.data.xfrc_applied.any()
    table = joint_table().select(ACTUATED)
    assert (np.abs(log.torques) <= table.torque_limit_nm() + 1e-6).all()


def test_after_a_real_fall() -> None:
    nao = Nao(fingers=False)
    torso = nao.model.body("torso").id
    for _ in range(15):
        nao.data.xfrc_applied[torso, 0] = -30.0
        nao.step()
    nao.data.xfrc_applied[:] = 0
    nao.step(100)
    assert nao.fallen
    log = get_up(nao)
    assert not log.fallen
    assert log.torso_pose[0, 2] < 0.15
    assert log.torso_pose[-1, 2] > 0.3


@pytest.mark.parametrize("side", SIDES)
def test_the_motion_keeps_ranges_and_nominal_speeds(side: Lie) -> None:
    trajectory = get_up_trajectory(side, STANCE)
    check(trajectory)
    np.testing.assert_allclose(trajectory.targets[0], STANCE)
    np.testing.assert_allclose(trajectory.targets[-1], STANCE)


@pytest.mark.parametrize("side", SIDES)
def test_the_motion_is_symmetric(side: Lie) -> None:
    targets = get_up_trajectory(side, STANCE).targets
    for name in ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "HipRoll", "HipPitch", "AnkleRoll"):
        sign = -1 if name.endswith(("Roll", "Yaw")) else 1
        left, right = (targets[:, ACTUATED.index(side_name + name)] for side_name in "LR")
        np.testing.assert_allclose(right, sign * left, atol=1e-9)


def test_an_upright_robot_goes_to_stand_init() -> None:
    nao = Nao(fingers=False, posture="Stand")
    log = get_up(nao)
    assert not log.fallen
    assert log.time[-1] < 4.0
    assert np.rad2deg(np.abs(nao.angles - STANCE)).max() < 3.0
    with pytest.raises(MotionError, match="upright"):
        get_up_trajectory(Lie.UPRIGHT, STANCE)


@pytest.mark.parametrize(
    ("angles_deg", "lie"),
    [((0, 0, 0), Lie.UPRIGHT), ((90, 80, 0), Lie.BELLY), ((-50, -95, 0), Lie.BACK), ((0, 20, 85), Lie.BELLY)],
)
def test_how_it_lies(angles_deg: tuple[float, float, float], lie: Lie) -> None:
    assert lie_of(Rotation.from_euler("ZYX", angles_deg, degrees=True).as_quat(scalar_first=True)) is lie


def test_a_robot_without_strength_stays_down_and_says_so() -> None:
    nao = lying(Lie.BACK)
    nao.model.actuator_forcerange[:] *= 0.05
    log = get_up(nao)
    assert log.fallen
    assert log.fell_at == pytest.approx(log.time[-1])
