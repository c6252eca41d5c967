"""How near the body comes to itself."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.perform import MotionLog
from nao_sim.robot.wiring import find_robot

# Parts further apart than this are not looked at closely, metres.
_FAR_M = 0.25
# Every third control period: 60 ms, in which the fastest hand moves less than the shells are thick.
_STRIDE = 3


def touching_pairs(model: mujoco.MjModel, prefix: str | None = None) -> NDArray[np.int64]:
    """Return the pairs of geoms of the robot that could touch, shape (p, 2): what MuJoCo itself would collide."""
    robot = np.flatnonzero(find_robot(model, prefix).geoms).tolist()
    excluded = set(model.exclude_signature.tolist())
    pairs = [
        (first, second)
        for index, first in enumerate(robot)
        for second in robot[index + 1 :]
        if _collide(model, first, second, excluded)
    ]
    return np.array(pairs, dtype=np.int64).reshape(-1, 2)


def _collide(model: mujoco.MjModel, first: int, second: int, excluded: set[int]) -> bool:
    types, affinities = model.geom_contype, model.geom_conaffinity
    if not (types[first] & affinities[second] or types[second] & affinities[first]):
        return False
    one, two = sorted((int(model.geom_bodyid[first]), int(model.geom_bodyid[second])))
    welded = model.body_weldid
    if welded[one] == welded[two] or (one << 16) + two in excluded:
        return False
    parents = welded[model.body_parentid[welded[one]]], welded[model.body_parentid[welded[two]]]
    return bool(parents[0] != welded[two] and parents[1] != welded[one])


def nearest_self_distance(model: mujoco.MjModel, log: MotionLog, prefix: str | None = None) -> tuple[float, str, float]:
    """Return the least distance in m between two parts, their names, and when (s).

    Args:
        model: the model that made the log.
        log: the motion; body poses are taken from it.
        prefix: which robot, where the model has several.
    """
    pairs = touching_pairs(model, prefix)
    data = mujoco.MjData(model)
    reach = model.geom_rbound
    best, best_pair, best_time = _FAR_M, (-1, -1), 0.0
    for time, pose in zip(log.time[::_STRIDE], log.body_pose[::_STRIDE], strict=True):
        place_geoms(model, data, pose)
        centres = data.geom_xpos
        gap = np.linalg.norm(centres[pairs[:, 0]] - centres[pairs[:, 1]], axis=1) - reach[pairs].sum(axis=1)
        for first, second in pairs[gap < best]:
            distance = mujoco.mj_geomDistance(model, data, int(first), int(second), best, None)
            if distance < best:
                best, best_pair, best_time = distance, (int(first), int(second)), float(time)
    if best_pair[0] < 0:
        return best, "-", 0.0
    return best, " and ".join(model.geom(geom).name for geom in best_pair), best_time


def place_geoms(model: mujoco.MjModel, data: mujoco.MjData, body_pose: NDArray[np.float64]) -> None:
    """Write the geoms' world poses for body poses, shape (nbody, 7), position m and quaternion w, x, y, z."""
    for geom in range(model.ngeom):
        pose = body_pose[model.geom_bodyid[geom]]
        position, quat = np.empty(3), np.empty(4)
        mujoco.mju_mulPose(position, quat, pose[:3], pose[3:], model.geom_pos[geom], model.geom_quat[geom])
        data.geom_xpos[geom] = position
        mujoco.mju_quat2Mat(data.geom_xmat[geom], quat)
