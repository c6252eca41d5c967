"""The surface of a person, skinned to the skeleton of ``models/person`` and reshaped without recompiling.

The surface is melted once at the build pose of ``assets/people/shape.toml``; every vertex hangs on at most four bodies.
Another person is another scale per body: rest offsets and bound vertices of the compiled model are rewritten in
place, so that a data set of many persons needs one model and one renderer.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.people.actors.mesh_cutting import Mesh, outward_normals, split
from nao_sim.people.actors.surface import RoundCone, melt_cones
from nao_sim.people.arrays import Array
from nao_sim.resources import resource

HIDDEN_GROUP = 5
_MIRROR = np.array([1.0, -1.0, 1.0])


@dataclass(frozen=True)
class Part:
    """What is coloured as one, at the build pose.

    Vertices and outward normals (n, 3) in m, faces (m, 3), and how much each vertex hangs on each body, (n, nbody).
    """

    name: str
    vertices: Array
    faces: NDArray[np.int32]
    normals: Array
    weights: Array


def skeleton() -> mujoco.MjSpec:
    """Return the editable skeleton of the 1.75 m person."""
    return mujoco.MjSpec.from_file(str(resource("models", "person", "person.xml")))


@lru_cache(maxsize=3)
def parts(detail: float = 1.0) -> tuple[Part, ...]:
    """Melt and skin all parts; ``detail`` divides the grid spacing, above 1 that of the hand alone.

    2 shows the hand in close-up, 1 a person, and below 1 a person in a small picture.
    """
    with resource("assets", "people", "shape.toml").open("rb") as file:
        shape = tomllib.load(file)
    model = skeleton().compile()
    frames = build_frames(model, shape["build_pose_deg"])
    return tuple(part for name, piece in shape["piece"].items() for part in _piece(model, frames, name, piece, detail))


def build_frames(model: mujoco.MjModel, pose_deg: Mapping[str, float]) -> Array:
    """World poses (nbody, 3, 4) of all bodies of ``model`` at the build pose (degrees; both sides alike)."""
    data = mujoco.MjData(model)
    for name, angle in pose_deg.items():
        for side in ("r_", "l_"):
            data.joint(side + name).qpos = np.radians(angle)
    mujoco.mj_kinematics(model, data)
    return np.concatenate([data.xmat.reshape(-1, 3, 3), data.xpos[:, :, None]], axis=2)


def _piece(model: mujoco.MjModel, frames: Array, name: str, piece: dict[str, Any], detail: float) -> list[Part]:
    """Melt one piece of the shape file and cut it into its parts; a piece of side cones is made once and mirrored."""
    alone = name == "hand"
    spacing = piece["spacing"] / (detail if alone else min(detail, 1.0))
    cones = [cone for row in piece["cones"] for cone in _cones(model, frames, row, right_only=alone)]
    paint = [cone for row in piece.get("paint", []) for cone in _cones(model, frames, row, right_only=alone)]
    mesh = Mesh(*melt_cones(cones, spacing, piece["melt"]))
    mesh = Mesh(mesh.vertices, mesh.faces, outward_normals(mesh), _weights(model, cones, mesh.vertices))
    labels = list(dict.fromkeys(cone.part for cone in [*cones, *paint]))
    distance = np.stack([_part_distance(cones, paint, label, mesh.vertices) for label in labels])
    cut = [Part(labels[k], *piece_mesh) for k, piece_mesh in split(mesh, distance)]
    return [_with_mirror(model, part) for part in cut] if alone else cut


def _part_distance(cones: list[RoundCone], paint: list[RoundCone], label: str, points: Array) -> Array:
    """How far ``points`` are from a part (n,); a painted part wins wherever the points lie inside it."""
    painted = [cone for cone in paint if cone.part == label]
    if painted:
        inside = np.min([cone.distance(points) for cone in painted], axis=0)
        return inside + np.min([cone.distance(points) for cone in cones], axis=0)
    return np.asarray(np.min([cone.distance(points) for cone in cones if cone.part == label], axis=0))


def _cones(model: mujoco.MjModel, frames: Array, row: dict[str, Any], right_only: bool) -> list[RoundCone]:
    """The round cone of a row of the shape file, and its left twin for a side row."""
    sides = (("r", False),) if right_only else (("r", False), ("l", True))
    found = []
    for side, mirrored in sides if row.get("side") else (("", False),):
        body = f"{side}_{row['body']}" if side and _has_body(model, f"{side}_{row['body']}") else row["body"]
        flip = _MIRROR if mirrored else np.ones(3)
        a, b = (np.array(row[end]) * flip for end in ("a", "b"))
        squash = np.array(row.get("squash", [1.0, 1.0, 1.0]))
        frame = frames[model.body(body).id]
        found.append(RoundCone(body, row["part"], a, b, (row["radii"][0], row["radii"][1]), squash, frame))
    return found


def _has_body(model: mujoco.MjModel, name: str) -> bool:
    return mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) >= 0


def _weights(model: mujoco.MjModel, cones: list[RoundCone], vertices: Array) -> Array:
    """Hang each vertex on its nearest body and that body's neighbours in the tree, by distance; shape (n, nbody)."""
    distance = np.full((len(vertices), model.nbody), np.inf)
    size = np.ones(model.nbody)
    for cone in cones:
        body = model.body(cone.body).id
        distance[:, body] = np.minimum(distance[:, body], cone.distance(vertices))
        size[body] = max(cone.radii)
    near = distance.argmin(axis=1)
    parent = model.body_parentid
    related = (near[:, None] == np.arange(model.nbody)) | (parent[near][:, None] == np.arange(model.nbody))
    related |= parent[None, :] == near[:, None]
    # The softness of a joint goes with the thickness of the limb there.
    softness = 0.25 * size[near][:, None]
    gap = np.where(related, distance - distance[np.arange(len(near)), near][:, None], np.inf)
    raw = np.exp(-gap / softness)
    raw[raw < np.sort(raw, axis=1)[:, -4][:, None]] = 0.0
    return raw / raw.sum(axis=1, keepdims=True)


def _with_mirror(model: mujoco.MjModel, part: Part) -> Part:
    """Add the left twin of a right part."""
    twin = np.arange(model.nbody)
    for body in range(model.nbody):
        name = model.body(body).name
        if name.startswith("r_"):
            left = model.body("l_" + name[2:]).id
            twin[body], twin[left] = left, body
    faces = np.concatenate([part.faces, part.faces[:, ::-1] + len(part.vertices)]).astype(np.int32)
    return Part(
        part.name,
        np.concatenate([part.vertices, part.vertices * _MIRROR]),
        faces,
        np.concatenate([part.normals, part.normals * _MIRROR]),
        np.concatenate([part.weights, part.weights[:, twin]]),
    )


def _quat(rotation: Array) -> Array:
    """Unit quaternion (4,), w first, of a rotation matrix (3, 3)."""
    quat = np.zeros(4)
    mujoco.mju_mat2Quat(quat, rotation.ravel())
    return quat


class Figure:
    """The skins of one person in a model: added to a spec once, then reshaped in the compiled model."""

    def __init__(self, detail: float = 1.0) -> None:
        self.parts = parts(detail)
        with resource("assets", "people", "shape.toml").open("rb") as file:
            self._build_pose: dict[str, float] = tomllib.load(file)["build_pose_deg"]
        self._nominal = skeleton().compile()
        self._frames = build_frames(self._nominal, self._build_pose)

    def add_to(self, spec: mujoco.MjSpec) -> None:
        """Add one skin per part to ``spec``, which holds the skeleton unchanged."""
        for part in self.parts:
            skin = spec.add_skin(name=part.name)
            skin.vert, skin.face = part.vertices.ravel().tolist(), part.faces.ravel().tolist()
            bones = np.flatnonzero(part.weights.any(axis=0))
            quats = np.array([_quat(self._frames[body, :, :3]) for body in bones])
            skin.bodyname = [self._nominal.body(body).name for body in bones]
            skin.bindpos = self._frames[bones, :, 3].ravel().tolist()
            skin.bindquat = quats.ravel().tolist()
            held = [np.flatnonzero(part.weights[:, body]) for body in bones]
            skin.vertid = [ids.tolist() for ids in held]
            skin.vertweight = [part.weights[ids, body].tolist() for ids, body in zip(held, bones, strict=True)]
            skin.rgba = [0.8, 0.6, 0.5, 1.0]

    def reshape(self, model: mujoco.MjModel, scale: Mapping[str, Array], thickness: Mapping[str, float]) -> None:
        """Give ``model`` other proportions in place.

        Args:
            model: compiled from the spec that :meth:`add_to` filled.
            scale: factors (3,) along each body's own x, y, z; a body that is not named keeps its size.
            thickness: how far (m) a part lies outside the bare surface, as cloth does.
        """
        count = self._nominal.nbody
        factors = np.ones((count, 3))
        for name, factor in scale.items():
            factors[self._nominal.body(name).id] = factor
        parent = self._nominal.body_parentid
        model.body_pos[1:count] = self._nominal.body_pos[1:] * factors[parent[1:]]
        model.body_pos[1, 2] = self._leg_length(factors)
        self._nominal_like(model, count)
        frames = self._frames_of(model, count)
        for part in self.parts:
            self._rebind(model, part, factors, frames, thickness.get(part.name, 0.0))

    def _leg_length(self, factors: Array) -> float:
        """Height of the hip joints (m) that puts the soles on the floor."""
        body = self._nominal.body
        thigh, shin, foot = (body(f"r_{n}").id for n in ("thigh", "shin", "foot"))
        offset = -self._nominal.body_pos[:, 2]
        return float(offset[shin] * factors[thigh, 2] + offset[foot] * factors[shin, 2] + 0.072 * factors[foot, 2])

    def _nominal_like(self, model: mujoco.MjModel, count: int) -> None:
        if model.body(count - 1).name != self._nominal.body(count - 1).name:
            raise AssertionError("the person's bodies must come first in the model")

    def _frames_of(self, model: mujoco.MjModel, count: int) -> Array:
        return build_frames(model, self._build_pose)[:count]

    def _rebind(self, model: mujoco.MjModel, part: Part, factors: Array, frames: Array, thickness: float) -> None:
        """Move the bound vertices of one skin, and the poses they are bound to."""
        skin = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SKIN, part.name)
        bones = np.flatnonzero(part.weights.any(axis=0))
        source = part.vertices + thickness * part.normals
        moved = np.zeros_like(source)
        for body in bones:
            local = (source - self._frames[body, :, 3]) @ self._frames[body, :, :3] * factors[body]
            moved += part.weights[:, body, None] * (local @ frames[body, :, :3].T + frames[body, :, 3])
        start = model.skin_vertadr[skin]
        model.skin_vert[start : start + model.skin_vertnum[skin]] = moved
        first = model.skin_boneadr[skin]
        for row, body in enumerate(bones):
            model.skin_bonebindpos[first + row] = frames[body, :, 3]
            model.skin_bonebindquat[first + row] = _quat(frames[body, :, :3])
