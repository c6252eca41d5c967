"""The compiled chains against the Denavit-Hartenberg rows that others published for this robot."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from nao_sim.robot import BODY, CHAINS, Nao, joint_table
from nao_sim.robot.placement import set_joints

# Published lengths, metres.
NECK, SHOULDER_Y, SHOULDER_Z = 0.1265, 0.098, 0.1
UPPER_ARM, ELBOW_Y, LOWER_ARM = 0.105, 0.015, 0.05595
HIP_Y, HIP_Z, THIGH, TIBIA, FOOT = 0.05, 0.085, 0.1, 0.1029, 0.04519
HEAD_TOP_M = 0.574


def _dh(a: float, alpha: float, d: float, theta: float) -> np.ndarray:
    """Modified Denavit-Hartenberg: Rx(alpha) Tx(a) Rz(theta) Tz(d)."""
    ca, sa, ct, st = np.cos(alpha), np.sin(alpha), np.cos(theta), np.sin(theta)
    return np.array([[ct, -st, 0, a], [st * ca, ct * ca, -sa, -sa * d], [st * sa, ct * sa, ca, ca * d], [0, 0, 0, 1]])


def _shift(x: float, y: float, z: float) -> np.ndarray:
    matrix = np.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def _arm(q: list[float], side: int) -> np.ndarray:
    half = np.pi / 2
    rows = [
        (0, -half, 0, q[0]),
        (0, half, 0, q[1] + half),
        (side * ELBOW_Y, half, UPPER_ARM, q[2]),
        (0, -half, 0, q[3]),
        (0, half, 0, q[4]),
    ]
    matrix = _shift(0, side * SHOULDER_Y, SHOULDER_Z)
    for row in rows:
        matrix = matrix @ _dh(*row)
    return matrix @ [0, 0, LOWER_ARM, 1]


def _leg(q: list[float], side: int) -> np.ndarray:
    half = np.pi / 2
    first = -3 * np.pi / 4 if side > 0 else -np.pi / 4
    rows = [
        (0, first, 0, q[0] - half),
        (0, -half, 0, q[1] + side * np.pi / 4),
        (0, half, 0, q[2]),
        (-THIGH, 0, 0, q[3]),
        (-TIBIA, 0, 0, q[4]),
        (0, -half, 0, q[5]),
    ]
    matrix = _shift(0, side * HIP_Y, -HIP_Z)
    for row in rows:
        matrix = matrix @ _dh(*row)
    return matrix @ [-FOOT, 0, 0, 1]


@pytest.mark.parametrize("seed", range(20))
def test_hands_and_soles_are_where_the_published_chain_puts_them(seed: int, model: mujoco.MjModel) -> None:
    low, high = joint_table().range_rad().T
    angles = np.random.default_rng(seed).uniform(low, high)
    angles[BODY.index("RHipYawPitch")] = angles[BODY.index("LHipYawPitch")]
    data = mujoco.MjData(model)
    set_joints(model, data, angles)
    mujoco.mj_kinematics(model, data)
    torso = data.body("torso").xpos
    by_name = dict(zip(BODY, angles, strict=True))
    for side, letter in ((1, "L"), (-1, "R")):
        arm = _arm([by_name[n] for n in CHAINS[f"{letter}Arm"]], side)
        leg = _leg([by_name[n] for n in CHAINS[f"{letter}Leg"]], side)
        assert data.body(f"{letter.lower()}_hand").xpos - torso == pytest.approx(arm[:3], abs=1e-6)
        assert data.site(f"{letter.lower()}_sole").xpos - torso == pytest.approx(leg[:3], abs=1e-6)


def test_heights_of_straight_legs(standing: Nao) -> None:
    standing.reset("StandZero")
    data, model = standing.data, standing.model
    assert data.body("torso").xpos[2] == pytest.approx(FOOT + TIBIA + THIGH + HIP_Z, abs=2e-5)
    assert data.body("head").xpos[2] == pytest.approx(FOOT + TIBIA + THIGH + HIP_Z + NECK, abs=2e-5)
    shell = [
        g for g in range(model.ngeom) if model.geom_bodyid[g] == model.body("head").id and model.geom_group[g] == 2
    ]
    top = max(_top(model, data, g) for g in shell)
    assert top == pytest.approx(HEAD_TOP_M, abs=0.002)
    for site in ("l_sole", "r_sole"):
        assert data.site(site).xpos[2] == pytest.approx(0, abs=1e-5)


def _top(model: mujoco.MjModel, data: mujoco.MjData, geom: int) -> float:
    """Height of the highest point of an ellipsoid, cylinder or mesh geom."""
    axes, centre = data.geom_xmat[geom].reshape(3, 3)[2], data.geom_xpos[geom][2]
    kind = model.geom_type[geom]
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        start = model.mesh_vertadr[mesh]
        return centre + float((model.mesh_vert[start : start + model.mesh_vertnum[mesh]] @ axes).max())
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return centre + float(np.linalg.norm(model.geom_size[geom] * axes))
    radius, half = model.geom_size[geom][:2]
    return centre + float(radius * np.hypot(axes[0], axes[1]) + half * abs(axes[2]))


# Centre of mass of the V5.0 masses, computed apart from this model: height, and how far ahead of the ankles.
@pytest.mark.parametrize(
    ("name", "height", "ahead"),
    [
        ("StandZero", 0.2975, 0.0212),
        ("Stand", 0.2769, -0.0003),
        ("StandInit", 0.2715, 0.0231),
        ("Crouch", 0.2003, 0.0252),
    ],
)
def test_centre_of_mass_of_official_postures(name: str, height: float, ahead: float, standing: Nao) -> None:
    standing.reset(name)
    data = standing.data
    com = data.subtree_com[standing.model.body("torso").id]
    ankles = (data.body("l_ankle").xpos + data.body("r_ankle").xpos) / 2
    assert com[2] == pytest.approx(height, abs=0.0012)
    assert com[0] - ankles[0] == pytest.approx(ahead, abs=0.002)
    assert abs(com[1]) < 0.001
