"""Putting the robot into a posture: joints at their angles, soles on the floor."""

from __future__ import annotations

import mujoco
import numpy as np

from nao_sim.robot.joints import BODY
from nao_sim.robot.postures import Posture

SOLES = ("l_sole", "r_sole")


def place(model: mujoco.MjModel, data: mujoco.MjData, posture: Posture, limits: str = "thesis") -> None:
    """Reset the simulation into a posture, at rest.

    A standing posture stands on its soles, upright as they make it, torso above the origin; the others
    get the torso height and pitch of the posture file. A fixed base stays where it is.
    """
    mujoco.mj_resetData(model, data)
    set_joints(model, data, posture.clamped(limits))
    if model.joint(0).type[0] == mujoco.mjtJoint.mjJNT_FREE:
        _set_torso(model, data, posture)
    mujoco.mj_forward(model, data)


def set_joints(model: mujoco.MjModel, data: mujoco.MjData, angles: np.ndarray) -> None:
    """Write ``(26,)`` angles in ``BODY`` order into ``data.qpos``, fingertips and thumbs after their hands."""
    by_name = dict(zip(BODY, angles, strict=True))
    for k in range(model.njnt):
        name = model.joint(k).name
        if name in by_name:
            data.qpos[model.jnt_qposadr[k]] = by_name[name]
        elif name.endswith(("Fingertips", "Thumb")):
            data.qpos[model.jnt_qposadr[k]] = by_name[f"{name[0]}Hand"]


def _set_torso(model: mujoco.MjModel, data: mujoco.MjData, posture: Posture) -> None:
    if posture.torso is not None:
        height, pitch = posture.torso
        data.qpos[:7] = [0, 0, height, np.cos(pitch / 2), 0, np.sin(pitch / 2), 0]
        return
    # Upright and heading are the mean of both soles': in Crouch they are 2.9 degrees apart.
    mujoco.mj_kinematics(model, data)
    soles = sum(data.site(site).xmat.reshape(3, 3) for site in SOLES)
    up = soles[:, 2] / np.linalg.norm(soles[:, 2])
    left = np.cross(up, soles[:, 0])
    left /= np.linalg.norm(left)
    world = np.array([np.cross(left, up), left, up])
    mujoco.mju_mat2Quat(data.qpos[3:7], world.ravel())
    mujoco.mj_kinematics(model, data)
    data.qpos[:3] = [0, 0, data.qpos[2] - min(data.site(site).xpos[2] for site in SOLES)]
