"""A model file of somebody else's, MJCF or URDF, compiled as far as its files allow, hung up and without contacts."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

import mujoco

from nao_sim.robot.errors import RobotError
from nao_sim.robot.model import FIXED_HEIGHT_M

_NOTHING_KG = 1e-9
_DRAWN = frozenset({".stl", ".obj", ".msh"})


@dataclass(frozen=True, eq=False)
class Read:
    """What came of a file.

    Attributes:
        model: compiled, its base fixed, contacts off.
        format: ``"MJCF"`` or ``"URDF"``.
        name: the model's own.
        base: ``"free"`` or ``"fixed"``, as in the file.
        missing: files that it names and that are not there; their shapes are left out.
        weightless: bodies whose mass was to come from such shapes.
    """

    model: mujoco.MjModel
    format: str
    name: str
    base: str
    missing: tuple[str, ...]
    weightless: tuple[str, ...]


def read_model(path: Path) -> Read:
    """Read and compile a model file.

    Raises:
        RobotError: it is not there, not a model, or does not compile; MuJoCo's reason is in the line.
    """
    try:
        spec = mujoco.MjSpec.from_file(str(path))
    except Exception as error:  # MuJoCo raises ValueError and its own errors alike
        raise RobotError(f"{path} is not a model that MuJoCo reads: {_one_line(error)}") from error
    missing, weightless = _without_missing_files(spec, path)
    read = hung_up(spec, str(path))
    kind = "URDF" if _is_urdf(path) else "MJCF"
    return replace(read, format=kind, missing=missing, weightless=tuple(dict.fromkeys(weightless + read.weightless)))


def hung_up(spec: mujoco.MjSpec, path: str) -> Read:
    """Compile a specification with the robot's base fixed in the air and contacts off.

    Raises:
        RobotError: it does not compile.
    """
    base = "fixed"
    for key in list(spec.keys):
        spec.delete(key)
    for joint in [j for j in spec.joints if j.type == mujoco.mjtJoint.mjJNT_FREE]:
        # Every free body is hung up: the robot, and what else the scene has, where it is.
        if len(list(joint.parent.find_all("joint"))) > 1:
            base = "free"
            joint.parent.pos = [0, 0, FIXED_HEIGHT_M]
        spec.delete(joint)
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    model, weightless = _compiled(spec, path)
    return Read(model, "MJCF", spec.modelname, base, (), weightless)


def _compiled(spec: mujoco.MjSpec, path: str) -> tuple[mujoco.MjModel, tuple[str, ...]]:
    """Compile, moving bodies without mass with next to none of it; return those that carry nothing else, too."""
    spec.compiler.boundmass = max(spec.compiler.boundmass, _NOTHING_KG)
    spec.compiler.boundinertia = max(spec.compiler.boundinertia, _NOTHING_KG * 1e-3)
    try:
        model = spec.compile()
    except Exception as error:
        raise RobotError(f"{path} does not compile with its base fixed: {_one_line(error)}") from error
    carried = model.body_subtreemass
    light = [k for k in range(1, model.nbody) if model.body_dofnum[k] and carried[k] <= model.nbody * _NOTHING_KG]
    return model, tuple(model.body(k).name for k in light)


def _one_line(error: Exception) -> str:
    return " ".join(str(error).split())


def _is_urdf(path: Path) -> bool:
    return "<robot" in path.read_text("utf-8", errors="replace")[:100_000]


def _without_missing_files(spec: mujoco.MjSpec, path: Path) -> tuple[tuple[str, ...], tuple[str, ...]]:
    """Take out what cannot be loaded: shapes, pictures and height fields whose files are not there."""
    folder = path.absolute().parent
    missing, weightless = [], []
    for mesh in list(spec.meshes):
        if not mesh.file or _there(mesh.file, folder / spec.meshdir, _DRAWN):
            continue
        missing.append(mesh.file)
        name = mesh.name or Path(mesh.file).stem
        for geom in [g for g in spec.geoms if g.meshname == name]:
            body = geom.parent
            spec.delete(geom)
            if not body.explicitinertial and body.name != "world" and not list(body.geoms):
                weightless.append(body.name)
        spec.delete(mesh)
    for field in list(spec.hfields):
        if field.file and not _there(field.file, folder / spec.meshdir):
            missing.append(field.file)
            for geom in [g for g in spec.geoms if g.hfieldname == field.name]:
                spec.delete(geom)
            spec.delete(field)
    for texture in list(spec.textures):
        files = [file for file in (texture.file, *texture.cubefiles) if file]
        if files and not all(_there(file, folder / spec.texturedir) for file in files):
            missing += files
            used = texture.name or Path(texture.file).stem
            for material in spec.materials:
                material.textures = ["" if name == used else name for name in material.textures]
            spec.delete(texture)
    return tuple(missing), tuple(dict.fromkeys(weightless))


def _there(file: str, folder: Path, suffixes: frozenset[str] | None = None) -> bool:
    found = folder / file
    return found.is_file() and (suffixes is None or found.suffix.lower() in suffixes)
