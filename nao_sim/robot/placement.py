"""Putting the robot into a posture: joints at their angles, soles on what is under them."""

from __future__ import annotations

import mujoco
import numpy as np

from nao_sim.robot.errors import SceneError
from nao_sim.robot.joints import BODY
from nao_sim.robot.postures import Posture
from nao_sim.robot.rays import cast
from nao_sim.robot.wiring import Wiring, find_robot

SOLES = ("l_sole", "r_sole")
_FINGERS = ("Fingertips", "Thumb")
_HEAD_M = 0.6
"""The head is so high above the soles: what is higher is above the robot, not under it."""

_DEEPEST_M = 0.05
"""A robot that begins further inside something would be thrown about."""


def place(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    posture: Posture,
    limits: str = "thesis",
    wiring: Wiring | None = None,
    alone: bool = False,
) -> float:
    """Reset the simulation into a posture, at rest, and return the height of the ground under the robot, m.

    A standing posture stands on its soles, upright as they make it; the others get the torso height and pitch of the
    posture file. Place and heading are those of the torso in the scene's file, and what carries the robot there is the
    highest thing below its head. A fixed base stays where it is.

    Args:
        model, data: the scene.
        posture: where to put it.
        limits: the limit set that the angles are kept in.
        wiring: the robot; None to find it.
        alone: move the robot only, and leave the rest of the scene, its clock too, as it is.

    Raises:
        SceneError: the robot would begin deep inside something.
    """
    wiring = wiring or find_robot(model)
    if alone:
        _rest(model, data, wiring)
    else:
        mujoco.mj_resetData(model, data)
    set_joints(model, data, posture.clamped(limits), wiring)
    ground = 0.0
    if wiring.root is not None:
        ground = _set_torso(model, data, posture, wiring)
    mujoco.mj_forward(model, data)
    if wiring.root is not None:
        _refuse_to_start_inside(model, data, wiring)
    return ground


def _rest(model: mujoco.MjModel, data: mujoco.MjData, wiring: Wiring) -> None:
    """Take all motion, force and motor state from the robot's own bodies."""
    own = wiring.bodies
    data.qvel[own[model.dof_bodyid]] = 0
    data.qacc_warmstart[own[model.dof_bodyid]] = 0
    data.qfrc_applied[own[model.dof_bodyid]] = 0
    data.xfrc_applied[own] = 0
    for motor in wiring.motors:
        first, count = model.actuator_actadr[motor], model.actuator_actnum[motor]
        if first >= 0:
            data.act[first : first + count] = 0


def set_joints(model: mujoco.MjModel, data: mujoco.MjData, angles: np.ndarray, wiring: Wiring | None = None) -> None:
    """Write ``(26,)`` angles in ``BODY`` order into ``data.qpos``, fingertips and thumbs after their hands."""
    wiring = wiring or find_robot(model)
    by_name = {wiring.named(name): angle for name, angle in zip(BODY, angles, strict=True)}
    for side in "LR":
        by_name |= {wiring.named(f"{side}{part}"): by_name[wiring.named(f"{side}Hand")] for part in _FINGERS}
    for name, angle in by_name.items():
        joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        if joint >= 0:
            data.qpos[model.jnt_qposadr[joint]] = angle


def _set_torso(model: mujoco.MjModel, data: mujoco.MjData, posture: Posture, wiring: Wiring) -> float:
    """Place the torso and return the height of what carries the robot, m."""
    first = int(model.jnt_qposadr[wiring.root])
    pose = data.qpos[first : first + 7]
    home = model.qpos0[first : first + 7]
    w, x, y, z = home[3:]
    half = np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)) / 2
    heading = np.array([np.cos(half), 0.0, 0.0, np.sin(half)])
    if posture.torso is not None:
        height, pitch = posture.torso
        own = np.array([np.cos(pitch / 2), 0, np.sin(pitch / 2), 0])
        points = home[None, :2]
    else:
        own, points, height = _on_soles(model, data, wiring, pose, home, heading)
    mujoco.mju_mulQuat(pose[3:], heading, own)
    pose[:3] = home[:3]
    mujoco.mj_kinematics(model, data)
    ground = _ground(model, data, wiring, points, float(home[2]))
    pose[:3] = [home[0], home[1], ground + height]
    return ground


def _on_soles(
    model: mujoco.MjModel, data: mujoco.MjData, wiring: Wiring, pose: np.ndarray, home: np.ndarray, heading: np.ndarray
) -> tuple[np.ndarray, np.ndarray, float]:
    """Return the torso's orientation in a frame that stands upright, the ankles' places, and its height above them."""
    soles = [wiring.site(name) for name in SOLES]
    pose[:] = [0, 0, 0, 1, 0, 0, 0]
    mujoco.mj_kinematics(model, data)
    # Upright and heading are the mean of both soles': in Crouch they are 2.9 degrees apart.
    mean = sum(data.site_xmat[sole].reshape(3, 3) for sole in soles)
    up = mean[:, 2] / np.linalg.norm(mean[:, 2])
    left = np.cross(up, mean[:, 0])
    left /= np.linalg.norm(left)
    own = np.empty(4)
    mujoco.mju_mat2Quat(own, np.array([np.cross(left, up), left, up]).ravel())
    mujoco.mju_mulQuat(pose[3:], heading, own)
    mujoco.mj_kinematics(model, data)
    places = data.site_xpos[soles]
    return own, places[:, :2] + home[:2], -float(places[:, 2].min())


def _ground(model: mujoco.MjModel, data: mujoco.MjData, wiring: Wiring, points: np.ndarray, torso: float) -> float:
    """Return the height of the highest thing under any of some points, m; where there is nothing, as the file has it.

    Args:
        points: places on the ground, m, shape (n, 2).
        torso: its height in the scene's file, m, where it stands with straight legs.
    """
    straight = torso - _straight_m(wiring)
    passed = wiring.geoms | ((model.geom_contype == 0) & (model.geom_conaffinity == 0))
    down = np.array([[0.0, 0.0, -1.0]])
    top = straight + _HEAD_M
    heights = [top - cast(model, data, passed, np.array([*point, top]), down)[0] for point in points]
    highest = max(heights)
    # Rounding of the ray must not lift a robot off a floor at zero.
    return round(float(highest), 9) if np.isfinite(highest) else straight


def _straight_m(wiring: Wiring) -> float:
    """Return how high the torso is above the soles with all joints at zero, m."""
    model = wiring.model
    height, body = 0.0, int(model.site_bodyid[wiring.site(SOLES[0])])
    height -= float(model.site_pos[wiring.site(SOLES[0]), 2])
    while body != wiring.torso:
        height -= float(model.body_pos[body, 2])
        body = int(model.body_parentid[body])
    return height


def _refuse_to_start_inside(model: mujoco.MjModel, data: mujoco.MjData, wiring: Wiring) -> None:
    for contact in data.contact:
        ours = [geom >= 0 and bool(wiring.geoms[geom]) for geom in contact.geom]
        if contact.dist < -_DEEPEST_M and ours[0] != ours[1]:
            other = int(contact.geom[1] if ours[0] else contact.geom[0])
            thing = model.geom(other).name if other >= 0 else ""
            thing = thing or model.body(model.geom_bodyid[other]).name or "the world"
            raise SceneError(
                f"the robot would begin {-1e3 * contact.dist:.0f} mm inside '{thing}'; move that, or the body "
                f"'{wiring.named('torso')}' in the scene"
            )
