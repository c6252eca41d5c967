"""The closed-form legs against the compiled model's own forward kinematics."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from nao_sim.motion.walking.leg_kinematics import LEG_COLUMNS, SOLE_BELOW_ANKLE_M, solve_legs
from nao_sim.robot.joints import ACTUATED
from nao_sim.robot.model import model_spec
from nao_sim.robot.postures import posture

MODEL = model_spec(fingers=False, scene=False).compile()
ZERO = np.zeros(())


def soles(torso: np.ndarray, roll: float, pitch: float, heading: float, legs: np.ndarray) -> list[tuple]:
    """Return place and orientation of both soles by MuJoCo's kinematics."""
    data = mujoco.MjData(MODEL)
    data.qpos[:3] = torso
    data.qpos[3:7] = Rotation.from_euler("ZYX", [heading, pitch, roll]).as_quat(scalar_first=True)
    for column, angle in zip(LEG_COLUMNS, legs, strict=True):
        data.qpos[MODEL.joint(ACTUATED[column]).qposadr[0]] = angle
    data.qpos[MODEL.joint("RHipYawPitch").qposadr[0]] = legs[0]
    mujoco.mj_kinematics(MODEL, data)
    sites = [data.site(name) for name in ("l_sole", "r_sole")]
    return [(site.xpos.copy(), site.xmat.reshape(3, 3).copy()) for site in sites]


small = st.floats(-0.03, 0.03)


@settings(max_examples=60, deadline=None)
@given(
    x=st.tuples(small, small),
    spread=st.tuples(st.floats(0.045, 0.09), st.floats(0.045, 0.09)),
    z=st.tuples(st.floats(0, 0.02), st.floats(0, 0.02)),
    toe=st.tuples(st.floats(-0.1, 0.4), st.floats(-0.1, 0.4)),
    height=st.floats(0.28, 0.31),
    lean=st.tuples(st.floats(-0.1, 0.1), st.floats(-0.1, 0.2)),
)
def test_both_soles_are_where_they_were_asked_for(x, spread, z, toe, height, lean) -> None:
    feet = np.array([[x[0], spread[0], z[0], toe[0]], [x[1], -spread[1], z[1], -toe[1]]])
    torso = np.array([0.0, 0.0, height])
    legs, heading = solve_legs(torso, np.array(lean[0]), np.array(lean[1]), feet)
    for (place, turned), wanted in zip(soles(torso, lean[0], lean[1], float(heading), legs), feet, strict=True):
        np.testing.assert_allclose(place, wanted[:3], atol=1e-9)
        # The shared hip motor is met by turning the torso; what its last step leaves is far below a joint's play.
        np.testing.assert_allclose(turned, Rotation.from_euler("z", wanted[3]).as_matrix(), atol=2e-4)


def test_the_official_posture_comes_back() -> None:
    stance = posture("StandInit")
    wanted = np.array([stance[ACTUATED[column]] for column in LEG_COLUMNS])
    pitch = -float(stance["LHipPitch"] + stance["LKneePitch"] + stance["LAnklePitch"])
    (left, _), (right, _) = soles(np.zeros(3), 0.0, pitch, 0.0, wanted)
    feet = np.array([[*left, 0.0], [*right, 0.0]])
    legs, heading = solve_legs(np.zeros(3), ZERO, ZERO + pitch, feet)
    np.testing.assert_allclose(legs, wanted, atol=1e-6)
    assert float(heading) == pytest.approx(0.0, abs=1e-9)


def test_a_batch_is_solved_as_its_members() -> None:
    rng = np.random.default_rng(3)
    feet = np.array([[0.0, 0.05, 0.0, 0.1], [0.0, -0.05, 0.0, -0.1]]) + rng.uniform(-0.01, 0.01, (4, 3, 2, 4))
    torso = np.array([0.0, 0.0, 0.3]) + rng.uniform(-0.01, 0.01, (4, 3, 3))
    roll, pitch = rng.uniform(-0.05, 0.05, (2, 4, 3))
    legs, heading = solve_legs(torso, roll, pitch, feet)
    assert legs.shape == (4, 3, 11)
    one, one_heading = solve_legs(torso[2, 1], roll[2, 1], pitch[2, 1], feet[2, 1])
    np.testing.assert_allclose(legs[2, 1], one, atol=1e-12)
    assert heading[2, 1] == pytest.approx(one_heading)


def test_mirrored_feet_take_mirrored_legs() -> None:
    feet = np.array([[0.02, 0.06, 0.01, 0.2], [-0.01, -0.05, 0.0, -0.1]])
    mirrored = feet[::-1] * [1, -1, 1, -1]
    torso = np.array([0.01, 0.01, 0.3])
    legs, _ = solve_legs(torso, np.array(0.03), np.array(0.1), feet)
    other, _ = solve_legs(torso * [1, -1, 1], np.array(-0.03), np.array(0.1), mirrored)
    names = [ACTUATED[column] for column in LEG_COLUMNS]
    for name, angle in zip(names, legs, strict=True):
        twin = {"L": "R", "R": "L"}[name[0]] + name[1:] if "YawPitch" not in name else name
        sign = -1 if name.endswith("Roll") else 1
        assert other[names.index(twin)] == pytest.approx(sign * angle, abs=1e-6), name


def test_a_foot_out_of_reach_stretches_the_leg() -> None:
    feet = np.array([[0.0, 0.05, 0.0, 0.0], [0.0, -0.05, 0.0, 0.0]])
    legs, _ = solve_legs(np.array([0.0, 0.0, 0.4]), ZERO, ZERO, feet)
    assert np.isfinite(legs).all()
    assert legs[3] == pytest.approx(0.0, abs=1e-6)  # the left knee
    assert pytest.approx(0.04519) == SOLE_BELOW_ANKLE_M
