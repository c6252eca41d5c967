"""The compiled model and its variants: limit set, mass, base, fingers, shells.

``models/nao/scene.xml`` is the robot as it stands in the file (thesis limits, documented mass, free base, moving
fingers, shells); every other variant is that file with a few elements changed before it is compiled.
"""

from __future__ import annotations

import tomllib
from typing import Literal

import mujoco

from nao_sim.resources import resource
from nao_sim.robot.errors import UnknownNameError
from nao_sim.robot.joints import joint_table

Mass = Literal["documented", "thesis"]
Base = Literal["free", "fixed"]

FIXED_HEIGHT_M = 0.5
"""Height of the torso when the base is fixed: the feet hang clear of the floor."""

_SHELL_GROUP, _COLLISION_GROUP = 2, 3
_SMALL_JOINTS = ("Fingertips", "Thumb")


def mass_scale(mass: str = "documented") -> float:
    """Return the factor on every documented link mass: 1, or what gives the thesis's 4.3 kg."""
    if mass not in ("documented", "thesis"):
        raise UnknownNameError("mass", mass, ("documented", "thesis"))
    if mass == "documented":
        return 1.0
    data = tomllib.loads(resource("assets", "nao", "links.toml").read_text("utf-8"))
    total = sum(
        row["mass_kg"] * (2 if name.startswith("l_") else 1) for name, row in data.items() if isinstance(row, dict)
    )
    return data["thesis_mass_kg"] / total


def model_spec(
    limits: str = "thesis",
    mass: str = "documented",
    base: str = "free",
    fingers: bool = True,
    scene: bool = True,
    shells: bool = True,
) -> mujoco.MjSpec:
    """Return an editable specification of a variant, for scenes of one's own.

    Args:
        limits: ``"thesis"`` (table A1-1), ``"v5"`` (H25 V5.0) or ``"envelope"`` (what both allow).
        mass: ``"documented"`` (5.305 kg) or ``"thesis"`` (4.3 kg, every link scaled alike).
        base: ``"free"``, or ``"fixed"`` with the torso hung up at ``FIXED_HEIGHT_M``.
        fingers: False keeps fingertips and thumb rigid, which saves four degrees of freedom.
        scene: with the floor and light of ``scene.xml``.
        shells: False leaves out the massless shells, which moves the robot the same and saves a tenth of the time;
            pictures then show the collision shapes.

    Raises:
        UnknownNameError: an argument has none of the listed values.
    """
    if base not in ("free", "fixed"):
        raise UnknownNameError("base", base, ("free", "fixed"))
    spec = mujoco.MjSpec.from_file(str(resource("models", "nao", "scene.xml" if scene else "nao.xml")))
    _set_limits(spec, limits)
    _scale_masses(spec, mass_scale(mass))
    if base == "fixed":
        for key in list(spec.keys):
            spec.delete(key)
        spec.delete(spec.joint("root"))
        spec.body("torso").pos = [0, 0, FIXED_HEIGHT_M]
    if not fingers:
        _stiffen_fingers(spec)
    if not shells:
        _undress(spec)
    return spec


def _set_limits(spec: mujoco.MjSpec, limits: str) -> None:
    table = joint_table()
    for joint, (low, high) in zip(table.joints, table.range_rad(limits), strict=True):
        spec.joint(joint.name).range = [low, high]
        if joint.follows is None:
            spec.actuator(joint.name).ctrlrange = [low, high]


def _scale_masses(spec: mujoco.MjSpec, scale: float) -> None:
    for body in spec.bodies:
        body.mass *= scale
        body.inertia = body.inertia * scale
        body.fullinertia = body.fullinertia * scale


def _stiffen_fingers(spec: mujoco.MjSpec) -> None:
    for key in list(spec.keys):
        spec.delete(key)
    for side in "LR":
        for part in _SMALL_JOINTS:
            spec.delete(spec.equality(f"{side}{part}"))
            spec.delete(spec.joint(f"{side}{part}"))


def _undress(spec: mujoco.MjSpec) -> None:
    for geom in list(spec.geoms):
        if geom.group == _SHELL_GROUP:
            spec.delete(geom)
        elif geom.group == _COLLISION_GROUP:
            geom.group = _SHELL_GROUP
