"""Where the centre of mass is, above what the feet cover."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial import ConvexHull
from scipy.spatial.transform import Rotation

from nao_sim.motion.perform import MotionLog
from nao_sim.robot.wiring import Wiring, find_robot

_SOLES = ("l_foot_sole", "r_foot_sole")
# A foot whose sensors together feel less than this does not stand (newtons).
_LOADED_N = 0.5


def centre_of_mass(
    model: mujoco.MjModel, body_pose: NDArray[np.float64], prefix: str | None = None
) -> NDArray[np.float64]:
    """Return the robot's centre of mass, m, shape (m, 3), for body poses of shape (m, nbody, 7)."""
    count, bodies = body_pose.shape[:2]
    turned = Rotation.from_quat(body_pose[..., 3:].reshape(-1, 4), scalar_first=True)
    local = np.tile(model.body_ipos, (count, 1))
    centres = body_pose[..., :3] + turned.apply(local).reshape(count, bodies, 3)
    robot = model.body_mass * find_robot(model, prefix).bodies
    return np.einsum("b,mbk->mk", robot, centres) / robot.sum()


def sole_corners(wiring: Wiring, body_pose: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the four lower corners of each sole in the world, m, shape (2, 4, 3), for poses of shape (nbody, 7)."""
    signs = np.array([[1, 1, -1], [1, -1, -1], [-1, 1, -1], [-1, -1, -1]])
    corners = []
    for name in _SOLES:
        geom = wiring.model.geom(wiring.id(mujoco.mjtObj.mjOBJ_GEOM, name))
        pose = body_pose[geom.bodyid[0]]
        local = geom.pos + Rotation.from_quat(geom.quat, scalar_first=True).apply(signs * geom.size)
        corners.append(pose[:3] + Rotation.from_quat(pose[3:], scalar_first=True).apply(local))
    return np.array(corners)


def com_margins(model: mujoco.MjModel, log: MotionLog, prefix: str | None = None) -> NDArray[np.float64]:
    """Return the distance of the centre of mass's ground point from the edge of the support polygon.

    Returns:
        Metres, shape (m,); negative outside. A foot without load does not count; with none the margin is that of
        both, because the robot is in the air or lies.
    """
    wiring = find_robot(model, prefix)
    centre = centre_of_mass(model, log.body_pose, prefix)[:, :2]
    load = log.contacts.reshape(-1, 2, 4).sum(axis=2) > _LOADED_N
    margins = np.empty(len(centre))
    for moment, (point, pose, standing) in enumerate(zip(centre, log.body_pose, load, strict=True)):
        corners = sole_corners(wiring, pose)[standing if standing.any() else slice(None)].reshape(-1, 3)[:, :2]
        # Each row of the hull is a unit normal and an offset, negative inside.
        sides = ConvexHull(corners).equations
        margins[moment] = -(sides[:, :2] @ point + sides[:, 2]).max()
    return margins
