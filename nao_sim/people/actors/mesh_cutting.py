"""Cutting one surface into parts along clean lines: triangles that two parts share are divided where they meet."""

from __future__ import annotations

from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from nao_sim.people.arrays import Array


class Mesh(NamedTuple):
    """Vertices (n, 3), faces (m, 3), and per vertex normals (n, 3) and weights (n, k); the latter may be empty."""

    vertices: Array
    faces: NDArray[np.int32]
    normals: Array = np.empty((0, 3))
    weights: Array = np.empty((0, 0))


def outward_normals(mesh: Mesh) -> Array:
    """Unit normals (n, 3) at the vertices, from the faces around them weighted by area."""
    corner = mesh.vertices[mesh.faces]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    total = np.zeros_like(mesh.vertices)
    for k in range(3):
        np.add.at(total, mesh.faces[:, k], normal)
    return np.asarray(total / np.maximum(np.linalg.norm(total, axis=1, keepdims=True), 1e-12))


def split(mesh: Mesh, distance: Array) -> Iterator[tuple[int, Mesh]]:
    """Yield (part, its mesh) for every part that has faces; ``distance`` (parts, n) is that of each vertex to it.

    A vertex belongs to the nearest part. Faces whose corners belong to two parts are cut along the line of equal
    distance; the rare face at which three meet goes to its first corner's.
    """
    owner = distance.argmin(axis=0)
    corners = owner[mesh.faces]
    whole = (corners == corners[:, :1]).all(axis=1)
    three = (corners[:, 0] != corners[:, 1]) & (corners[:, 1] != corners[:, 2]) & (corners[:, 0] != corners[:, 2])
    kept = whole | three
    mesh, pieces, parts = _cut(mesh, corners, ~kept, distance)
    faces = np.concatenate([mesh.faces[kept], pieces])
    labels = np.concatenate([corners[kept, 0], parts])
    for part in np.unique(labels):
        used, local = np.unique(faces[labels == part], return_inverse=True)
        triangles: NDArray[np.int32] = local.reshape(-1, 3).astype(np.int32)
        yield int(part), Mesh(mesh.vertices[used], triangles, mesh.normals[used], mesh.weights[used])


def _cut(
    mesh: Mesh, corners: NDArray[np.intp], shared: NDArray[np.bool_], distance: Array
) -> tuple[Mesh, NDArray[np.int32], NDArray[np.intp]]:
    """Divide the ``shared`` faces: the mesh with the new vertices, the new faces, and the part of each."""
    faces, parts = mesh.faces[shared].copy(), corners[shared].copy()
    # Turn every face so that its odd corner comes first.
    for k in (1, 2):
        turn = parts[:, (k + 1) % 3] == parts[:, (k + 2) % 3]
        faces[turn], parts[turn] = np.roll(faces[turn], -k, axis=1), np.roll(parts[turn], -k, axis=1)
    odd, even = parts[:, 0], parts[:, 1]
    start, count = len(mesh.vertices), len(faces)
    blends = [_blend(mesh, distance, faces[:, 0], faces[:, k], odd, even) for k in (1, 2)]
    first, second = start + np.arange(count), start + count + np.arange(count)
    pieces = [
        np.stack([faces[:, 0], first, second], axis=1),
        np.stack([first, faces[:, 1], faces[:, 2]], axis=1),
        np.stack([first, faces[:, 2], second], axis=1),
    ]
    grown = Mesh(
        np.concatenate([mesh.vertices, *(b.vertices for b in blends)]),
        mesh.faces,
        np.concatenate([mesh.normals, *(b.normals for b in blends)]),
        np.concatenate([mesh.weights, *(b.weights for b in blends)]),
    )
    return grown, np.concatenate(pieces).astype(np.int32), np.concatenate([odd, even, even])


def _blend(
    mesh: Mesh,
    distance: Array,
    a: NDArray[np.int32],
    b: NDArray[np.int32],
    odd: NDArray[np.intp],
    even: NDArray[np.intp],
) -> Mesh:
    """The vertices on the edges a-b that are equally far from the parts ``odd`` and ``even``."""
    at_a = distance[odd, a] - distance[even, a]
    at_b = distance[odd, b] - distance[even, b]
    span = at_b - at_a
    share = np.clip(np.where(np.abs(span) > 1e-12, -at_a / np.where(span == 0, 1, span), 0.5), 0.0, 1.0)[:, None]

    def mix(values: Array) -> Array:
        return values[a] + share * (values[b] - values[a])

    return Mesh(mix(mesh.vertices), mesh.faces[:0], mix(mesh.normals), mix(mesh.weights))
