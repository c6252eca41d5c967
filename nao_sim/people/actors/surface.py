"""Closed surfaces from melted round cones: signed distances, a smooth union, and a surface net.

A limb is a round cone, a hand twenty of them; melting neighbours together gives one skin without seams, which a
row of capsules does not. Surface nets: Gibson, *Constrained elastic surface nets*, MICCAI 1998 (the naive variant:
one vertex per cell that the surface crosses, at the mean of its edge crossings).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.people.arrays import Array


@dataclass(frozen=True)
class RoundCone:
    """A ball swept from ``a`` to ``b`` (m) while its radius goes from ``radii[0]`` to ``radii[1]`` (m).

    ``frame`` is the (3, 4) pose of the body it belongs to, rotation and position; ``a`` and ``b`` are in that body's
    frame and ``squash`` stretches the cone about its own axis along the body's x, y and z.
    """

    body: str
    part: str
    a: Array
    b: Array
    radii: tuple[float, float]
    squash: Array
    frame: Array

    def distance(self, points: Array) -> Array:
        """Signed distance (m) of world ``points`` (n, 3), exact on the surface, below zero inside; shape (n,)."""
        local = (points - self.frame[:, 3]) @ self.frame[:, :3]
        axis = self.b - self.a
        length2 = max(float(axis @ axis), 1e-12)
        along = np.clip((local - self.a) @ axis / length2, 0.0, 1.0)
        offset = (local - self.a - along[:, None] * axis) / self.squash
        return np.linalg.norm(offset, axis=1) - (self.radii[0] + along * (self.radii[1] - self.radii[0]))


def smooth_union(distances: Array, melt: float) -> Array:
    """Melt distances (k, n) into one (n,): minus the soft minimum over a length ``melt`` (m)."""
    nearest = distances.min(axis=0)
    # log-sum-exp leaves a lone surface where it is and fillets where several are near.
    return nearest - melt / 4 * np.log(np.exp(-(distances - nearest) * 4 / melt).sum(axis=0))


def melt_cones(cones: list[RoundCone], spacing: float, melt: float) -> tuple[Array, NDArray[np.int32]]:
    """Mesh the melted ``cones`` on a grid of ``spacing`` (m): vertices (n, 3) in m and faces (m, 3)."""
    ends = np.array([c.frame[:, :3] @ p + c.frame[:, 3] for c in cones for p in (c.a, c.b)])
    reach = max(max(c.radii) * float(c.squash.max()) for c in cones) + melt + 2 * spacing
    low, high = ends.min(axis=0) - reach, ends.max(axis=0) + reach
    axes = [np.arange(lo, hi, spacing) for lo, hi in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    flat = grid.reshape(-1, 3)
    field = smooth_union(np.stack([c.distance(flat) for c in cones]), melt).reshape(grid.shape[:3])
    return surface_net(field, low, spacing)


def surface_net(field: Array, origin: Array, spacing: float) -> tuple[Array, NDArray[np.int32]]:
    """Vertices (n, 3) and outward triangles (m, 3) of ``field`` (x, y, z) = 0; the field must be positive outside.

    Args:
        field: samples on a regular grid, all positive on its border.
        origin: position of ``field[0, 0, 0]``, m.
        spacing: grid step, m.
    """
    inside = field < 0
    shape = np.array(field.shape) - 1
    total, count = np.zeros((*shape, 3)), np.zeros(shape)
    for axis in range(3):
        _add_crossings(field, inside, axis, total, count)
    cells = count > 0
    index = np.full(shape, -1, dtype=np.int32)
    index[cells] = np.arange(cells.sum(), dtype=np.int32)
    corner = np.argwhere(cells)
    vertices = origin + spacing * (corner + total[cells] / count[cells][:, None])
    return vertices, np.concatenate([_quads(inside, index, axis) for axis in range(3)])


def _add_crossings(field: Array, inside: NDArray[np.bool_], axis: int, total: Array, count: Array) -> None:
    """Add where the surface crosses the four edges along ``axis`` of each cell (in cells) to ``total``, ``count``."""
    lower = [slice(None)] * 3
    upper = [slice(None)] * 3
    lower[axis], upper[axis] = slice(0, -1), slice(1, None)
    start, end = field[tuple(lower)], field[tuple(upper)]
    crossed = inside[tuple(lower)] != inside[tuple(upper)]
    step = np.where(crossed, start, 0.0) / np.where(crossed, start - end, 1.0)
    others = [k for k in range(3) if k != axis]
    for u in (0, 1):
        for v in (0, 1):
            window = [slice(None)] * 3
            for k, shift in zip(others, (u, v), strict=True):
                window[k] = slice(shift, field.shape[k] - 1 + shift)
            hit = crossed[tuple(window)]
            count += hit
            total[..., axis] += np.where(hit, step[tuple(window)], 0.0)
            total[..., others[0]] += hit * u
            total[..., others[1]] += hit * v


def _quads(inside: NDArray[np.bool_], index: NDArray[np.int32], axis: int) -> NDArray[np.int32]:
    """Triangles (m, 3) around every grid edge along ``axis`` that the surface crosses, wound outwards."""
    u, v = (axis + 1) % 3, (axis + 2) % 3
    lower = np.moveaxis(inside, (axis, u, v), (0, 1, 2))[:-1, 1:-1, 1:-1]
    upper = np.moveaxis(inside, (axis, u, v), (0, 1, 2))[1:, 1:-1, 1:-1]
    cell = np.moveaxis(index, (axis, u, v), (0, 1, 2))
    at = np.argwhere(lower != upper)
    i, j, k = at[:, 0], at[:, 1] + 1, at[:, 2] + 1
    ring = np.stack([cell[i, j - 1, k - 1], cell[i, j, k - 1], cell[i, j, k], cell[i, j - 1, k]], axis=1)
    leaving = lower[at[:, 0], at[:, 1], at[:, 2]]
    ring[~leaving] = ring[~leaving][:, ::-1]
    return np.concatenate([ring[:, [0, 1, 2]], ring[:, [0, 2, 3]]]).astype(np.int32)
