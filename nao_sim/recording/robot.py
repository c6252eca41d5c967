"""The robot's body in a recording: its shells once, its link poses against time."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import mujoco
import numpy as np

from nao_sim.recording.moments import column

if TYPE_CHECKING:
    import rerun as rr

ROBOT = "world/robot"

# MuJoCo draws groups 0-2 by default; collision geometry lives in higher groups.
_VISIBLE_GROUPS = 3


def _entity(model: mujoco.MjModel, body: int) -> str:
    """Return the entity of a body; a scene's bodies may be called anything, or nothing."""
    import rerun as rr

    return f"{ROBOT}/{rr.escape_entity_path_part(model.body(body).name or f'body_{body}')}"


def _rgba(model: mujoco.MjModel, geom: int) -> np.ndarray:
    """Colour of a geom, float (4,): its material's if it has one."""
    material = model.geom_matid[geom]
    return model.mat_rgba[material] if material >= 0 else model.geom_rgba[geom]


def _visible_geoms(model: mujoco.MjModel, body: int) -> list[int]:
    first, count = model.body_geomadr[body], model.body_geomnum[body]
    geoms = range(first, first + count) if count else range(0)
    return [g for g in geoms if model.geom_group[g] < _VISIBLE_GROUPS and _rgba(model, g)[3] > 0]


def _mesh(model: mujoco.MjModel, geom: int) -> rr.Mesh3D:
    """A mesh geom's vertices and normals, carried into the frame of its body."""
    import rerun as rr

    mesh = model.geom_dataid[geom]
    vertices = slice(model.mesh_vertadr[mesh], model.mesh_vertadr[mesh] + model.mesh_vertnum[mesh])
    faces = slice(model.mesh_faceadr[mesh], model.mesh_faceadr[mesh] + model.mesh_facenum[mesh])
    normals = slice(model.mesh_normaladr[mesh], model.mesh_normaladr[mesh] + model.mesh_normalnum[mesh])
    rotation = np.empty(9)
    mujoco.mju_quat2Mat(rotation, model.geom_quat[geom])
    to_body = rotation.reshape(3, 3).T
    # MuJoCo indexes vertices and normals apart; Rerun has one index for both, so spread them over the corners.
    corner_vertex = model.mesh_face[faces].ravel()
    corner_normal = model.mesh_facenormal[faces].ravel()
    return rr.Mesh3D(
        vertex_positions=model.mesh_vert[vertices][corner_vertex] @ to_body + model.geom_pos[geom],
        vertex_normals=model.mesh_normal[normals][corner_normal] @ to_body,
        triangle_indices=np.arange(corner_vertex.size, dtype=np.uint32).reshape(-1, 3),
        albedo_factor=_rgba(model, geom),
    )


def _primitive(model: mujoco.MjModel, geom: int) -> rr.AsComponents | None:
    """A sphere, ellipsoid, capsule, cylinder or box geom in the frame of its body; None for others."""
    import rerun as rr

    size, position = model.geom_size[geom], model.geom_pos[geom]
    quaternion = model.geom_quat[geom][[1, 2, 3, 0]]
    placed: dict[str, Any] = {"quaternions": [quaternion], "colors": [_rgba(model, geom)], "fill_mode": "solid"}
    kind = mujoco.mjtGeom(model.geom_type[geom])
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return rr.Ellipsoids3D(half_sizes=[[size[0]] * 3], centers=[position], **placed)
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return rr.Ellipsoids3D(half_sizes=[size], centers=[position], **placed)
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        return rr.Boxes3D(half_sizes=[size], centers=[position], **placed)
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return rr.Cylinders3D(lengths=[2 * size[1]], radii=[size[0]], centers=[position], **placed)
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        # Rerun's capsule starts at its origin and extends along +z; MuJoCo's is centred.
        rotation = np.empty(9)
        mujoco.mju_quat2Mat(rotation, model.geom_quat[geom])
        foot = position - rotation.reshape(3, 3)[:, 2] * size[1]
        return rr.Capsules3D(lengths=[2 * size[1]], radii=[size[0]], translations=[foot], **placed)
    return None


def log_shells(stream: rr.RecordingStream, model: mujoco.MjModel) -> None:
    """Log every visible geom of the robot once, under the entity of its body.

    Args:
        stream: an open recording.
        model: the compiled model; body 0 (the world) is left out.
    """
    import rerun as rr

    stream.log("world", rr.ViewCoordinates.RIGHT_HAND_Z_UP, static=True)
    for body in range(1, model.nbody):
        for index, geom in enumerate(_visible_geoms(model, body)):
            is_mesh = model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH
            shape = _mesh(model, geom) if is_mesh else _primitive(model, geom)
            if shape is not None:
                stream.log(f"{_entity(model, body)}/shell_{index}", shape, static=True)


def log_body_poses(stream: rr.RecordingStream, model: mujoco.MjModel, time: np.ndarray, pose: np.ndarray) -> None:
    """Log the world pose of every body against time.

    Args:
        stream: an open recording.
        model: the compiled model that the poses belong to.
        time: seconds on the recording's timeline, shape (n,).
        pose: position [m] and quaternion (w, x, y, z) in the world frame, shape (n, nbody, 7).
    """
    import rerun as rr

    index = column(time)
    for body in range(1, model.nbody):
        columns = rr.Transform3D.columns(translation=pose[:, body, :3], quaternion=pose[:, body, [4, 5, 6, 3]])
        stream.send_columns(_entity(model, body), indexes=index, columns=columns)
