"""Motors behave like their datasheet: no-load speed, limit torque, and the line between."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from nao_sim.robot import ACTUATED, joint_table, model_spec

# One joint of every reduction.
JOINTS = ("HeadYaw", "LShoulderRoll", "LWristYaw", "LHand", "LHipYawPitch", "LHipPitch")


@pytest.fixture(scope="module")
def free() -> mujoco.MjModel:
    """The robot hung up, weightless, without stops, contacts or couplings: joints can spin."""
    spec = model_spec(base="fixed")
    spec.option.gravity = [0, 0, 0]
    spec.option.disableflags |= int(
        mujoco.mjtDisableBit.mjDSBL_CONTACT
        | mujoco.mjtDisableBit.mjDSBL_LIMIT
        | mujoco.mjtDisableBit.mjDSBL_EQUALITY
        | mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL
    )
    return spec.compile()


def _held(model: mujoco.MjModel, data: mujoco.MjData, free_dof: int) -> None:
    """Stop every other joint: only one is tested at a time."""
    speed = data.qvel[free_dof]
    data.qvel[:] = 0
    data.qvel[free_dof] = speed


@pytest.mark.parametrize("name", JOINTS)
def test_a_free_joint_spins_up_to_its_no_load_speed(name: str, free: mujoco.MjModel) -> None:
    data = mujoco.MjData(free)
    row, dof = ACTUATED.index(name), free.joint(name).dofadr[0]
    data.ctrl[row] = 1e4
    for _ in range(500):
        mujoco.mj_step(free, data)
        _held(free, data, dof)
    assert data.qvel[dof] == pytest.approx(joint_table()[name].no_load_speed, rel=0.02)


@pytest.mark.parametrize("name", ACTUATED)
def test_a_stalled_joint_gives_its_limit(name: str, free: mujoco.MjModel) -> None:
    data = mujoco.MjData(free)
    row = ACTUATED.index(name)
    for sign in (1, -1):
        data.ctrl[row] = sign * 1e3
        mujoco.mj_forward(free, data)
        assert data.actuator_force[row] == pytest.approx(sign * joint_table()[name].effort_nm, rel=0.02)


@pytest.mark.parametrize("name", JOINTS)
@pytest.mark.parametrize("fraction", [0.0, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0])
def test_torque_falls_along_the_line(name: str, fraction: float, free: mujoco.MjModel) -> None:
    joint = joint_table()[name]
    data = mujoco.MjData(free)
    row = ACTUATED.index(name)
    speed = fraction * joint.no_load_speed
    data.qvel[free.joint(name).dofadr[0]] = speed
    data.ctrl[row] = 1e4
    mujoco.mj_forward(free, data)
    line = joint.motor.stall_mnm * 1e-3 * joint.reduction * (1 - fraction)
    assert data.actuator_force[row] == pytest.approx(min(line, joint.effort_nm), rel=0.02, abs=1e-6)
    assert joint.torque_at(speed) == pytest.approx(min(line, joint.effort_nm), abs=1e-9)


def test_nominal_point_is_below_the_line() -> None:
    for joint in joint_table().joints:
        nominal = joint.motor.nominal_mnm * 1e-3 * joint.reduction
        ideal = joint.stall_torque * (1 - joint.nominal_speed / joint.no_load_speed)
        # The datasheet's nominal point lies within a fifth of the straight line through its ends.
        assert nominal == pytest.approx(ideal, rel=0.21)


def test_a_small_error_is_met_in_proportion(free: mujoco.MjModel) -> None:
    data = mujoco.MjData(free)
    row = ACTUATED.index("HeadYaw")
    data.ctrl[row] = 0.01
    mujoco.mj_forward(free, data)
    assert data.actuator_force[row] == pytest.approx(0.01 * free.actuator("HeadYaw").gainprm[4], rel=1e-6)
    assert np.abs(np.delete(data.actuator_force, row)).max() == 0
