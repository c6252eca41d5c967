"""Rays into the scene around the robot, which do not see the robot itself."""

from __future__ import annotations

import mujoco
import numpy as np

_SEEN, _UNSEEN = 0, 1
_MASK = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)


def cast(
    model: mujoco.MjModel,
    data: mujoco.MjData,
    unseen: np.ndarray,
    start: np.ndarray,
    directions: np.ndarray,
    most: float = np.inf,
) -> np.ndarray:
    """Return how far rays go, m, shape (n,); infinity where they meet nothing.

    Args:
        model, data: the scene; geom poses must be current.
        unseen: ``(ngeom,)`` bool, geoms that rays pass through; the groups of the others do not matter.
        start: where all of them begin, m, shape (3,).
        directions: unit vectors, shape (n, 3).
        most: no ray goes further, m.
    """
    count = len(directions)
    geom, distance = np.zeros(count, dtype=np.int32), np.zeros(count)
    kept = model.geom_group.copy()
    model.geom_group[:] = np.where(unseen, _UNSEEN, _SEEN)
    cutoff = most if np.isfinite(most) else float(mujoco.mjMAXVAL)
    try:
        vectors = np.ascontiguousarray(directions, dtype=float).ravel()
        mujoco.mj_multiRay(model, data, start, vectors, _MASK, 1, -1, geom, distance, None, count, cutoff)
    finally:
        model.geom_group[:] = kept
    return np.where(geom >= 0, distance, np.inf)
