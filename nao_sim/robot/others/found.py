"""What a model is, said before it is judged: its joints and their names, axes, motors, base, and what is missing."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from itertools import permutations, product
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from nao_sim.robot.errors import RobotError
from nao_sim.robot.joints import BODY, LIMITS, joint_table
from nao_sim.robot.others.motors import Drive, drive_of
from nao_sim.robot.others.names import matched
from nao_sim.robot.others.reading import Read, hung_up, read_model

RANGE_RAD = 1e-4
"""A range printed with four digits is still that range."""

_PARALLEL = 0.99
_ALIKE = 0.94
_ENOUGH = 6
"""So few joints cannot tell a model that looks elsewhere from one with other axes."""

_SHOWN = 6


@dataclass(frozen=True, eq=False)
class Found:
    """What was found in a model.

    Attributes:
        read: the file.
        theirs: NAOqi's name → the model's, of the joints that are there.
        how: how the names were told.
        others: the model's joints that are none of NAO's.
        drives: NAOqi's name → what turns the joint, where something does.
        signs: NAOqi's name → 1; -1: the joint counts the other way round; 0: it turns about another axis.
        turned: the model's torso looks elsewhere than along x, with z up.
        sets: limit set → how many of the joints' ranges are those of the set.
    """

    read: Read
    theirs: Mapping[str, str]
    how: str
    others: tuple[str, ...]
    drives: Mapping[str, Drive]
    signs: Mapping[str, int]
    turned: bool
    sets: Mapping[str, int]

    def joint(self, name: str) -> int:
        """Return a joint's id in the model, or -1."""
        theirs = self.theirs.get(name)
        return -1 if theirs is None else mujoco.mj_name2id(self.read.model, mujoco.mjtObj.mjOBJ_JOINT, theirs)

    def range(self, name: str) -> np.ndarray | None:
        """Return a joint's range in NAO's direction, rad, shape (2,); None where it has none."""
        joint, model = self.joint(name), self.read.model
        if joint < 0 or not model.jnt_limited[joint]:
            return None
        low, high = model.jnt_range[joint]
        return np.array([-high, -low] if self.signs[name] < 0 else [low, high])

    def lines(self) -> list[tuple[str, str]]:
        """Return what was found as headings and sentences."""
        read, model = self.read, self.read.model
        lines = [("model", f"{read.format} '{read.name}', {len(self.theirs)} of NAO's {len(BODY)} joints")]
        lines.append(("names", self.how))
        missing = [name for name in BODY if name not in self.theirs]
        if missing:
            lines.append(("not there", _some(missing)))
        if self.others:
            lines.append(("others", f"joints that are none of NAO's: {_some(self.others)}"))
        lines.append(("motors", self._motors()))
        lines.append(("axes", self._axes()))
        lines.append(("ranges", self._ranges()))
        base = "free; hung up for the test" if read.base == "free" else "fixed"
        integrator = mujoco.mjtIntegrator(model.opt.integrator).name.removeprefix("mjINT_")
        lines.append(("base", f"{base}; time step {1e3 * model.opt.timestep:g} ms, {integrator}"))
        if read.missing:
            lines.append(("files", f"{len(read.missing)} not there, their shapes left out: {_some(read.missing, 2)}"))
        if read.weightless:
            lines.append(("masses", f"none is given for {_some(read.weightless)}, so nothing is driven"))
        return lines

    def as_dict(self) -> dict[str, Any]:
        """Return what was found as plain values."""
        read = self.read
        return {
            "format": read.format,
            "name": read.name,
            "base": read.base,
            "names": dict(self.theirs),
            "names_told": self.how,
            "other_joints": list(self.others),
            "actuators": {name: {"kind": d.kind, "takes": d.takes} for name, d in self.drives.items()},
            "mirrored": [name for name, sign in self.signs.items() if sign < 0],
            "other_axis": [name for name, sign in self.signs.items() if sign == 0],
            "ranges_of_set": dict(self.sets),
            "timestep_s": float(read.model.opt.timestep),
            "missing_files": list(read.missing),
            "bodies_without_mass": list(read.weightless),
        }

    def _motors(self) -> str:
        kinds = Counter((drive.kind, drive.takes) for drive in self.drives.values())
        parts = [f"{count} {kind} (takes {takes})" for (kind, takes), count in kinds.most_common()]
        idle = [name for name in self.theirs if name not in self.drives]
        if idle:
            parts.append(f"none for {_some(idle)}")
        return ", ".join(parts)

    def _axes(self) -> str:
        mirrored = [name for name, sign in self.signs.items() if sign < 0]
        other = [name for name, sign in self.signs.items() if sign == 0]
        parts = []
        if self.turned:
            parts.append("the model's torso looks elsewhere than along x")
        if mirrored:
            parts.append(f"counted the other way round: {_some(mirrored)}")
        if other:
            parts.append(f"other axes than NAO's in its zero pose: {_some(other)}")
        return "; ".join(parts) or "as NAOqi's"

    def _ranges(self) -> str:
        count = sum(self.range(name) is not None for name in self.theirs)
        told = ", ".join(f"{number} as '{name}'" for name, number in self.sets.items())
        best = max(self.sets, key=lambda name: self.sets[name])
        near = f"; judge it with --limits {best}" if self.sets[best] > self.sets["thesis"] else ""
        return f"{count} joints have one: {told}{near}"


def _some(names: Any, most: int = _SHOWN) -> str:
    shown = list(names)
    return ", ".join(shown[:most]) + (f" and {len(shown) - most} more" if len(shown) > most else "")


def look(path: Path, names: Mapping[str, str] | None = None) -> Found:
    """Read a model and tell what is in it.

    Args:
        path: an MJCF or URDF file.
        names: NAOqi's name → the model's; None: told by :func:`nao_sim.robot.others.names.matched`.

    Raises:
        RobotError: not a model, a name of the table that is not in it, or none of NAO's joints.
    """
    return _found(read_model(path), str(path), names)


def of_spec(spec: mujoco.MjSpec) -> Found:
    """Tell what is in a specification of our own."""
    return _found(hung_up(spec, "nao.xml"), "nao.xml", None)


def _found(read: Read, path: str, names: Mapping[str, str] | None) -> Found:
    model = read.model
    joints = [model.joint(k).name for k in range(model.njnt)]
    if names is None:
        theirs, how = matched(joints)
    else:
        lost = [name for name in names.values() if name not in joints]
        if lost:
            raise RobotError(f"{path} has no joint '{lost[0]}'; its joints: {_some(joints, 30)}")
        theirs, how = dict(names), "by the table of names"
    if not theirs:
        raise RobotError(
            f"{path} has none of NAO's joints ({_some(joints, 30) or 'it has no joints'}); if they are called "
            "otherwise, give a table: --names FILE with lines like 'HeadYaw,head.yaw'"
        )
    ids = {name: mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, theirs[name]) for name in theirs}
    drives = {name: drive for name, joint in ids.items() if (drive := drive_of(model, joint)) is not None}
    signs, turned = _signs(model, ids)
    others = tuple(name for name in joints if name and name not in theirs.values())
    found = Found(read, theirs, how, others, drives, signs, turned, {})
    return Found(read, theirs, how, others, drives, signs, turned, _sets(found))


def _signs(model: mujoco.MjModel, ids: Mapping[str, int]) -> tuple[dict[str, int], bool]:
    """Compare axes in the zero pose with the documented ones, in whichever way the model's torso looks."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    table = joint_table()
    axes = np.array([data.xaxis[joint] for joint in ids.values()])
    documented = np.array([table[name].axis for name in ids])
    documented /= np.linalg.norm(documented, axis=1, keepdims=True)
    own = data.xmat[model.body_parentid[model.jnt_bodyid[next(iter(ids.values()))]]].reshape(3, 3)
    ways = [np.eye(3), own] + (_right_angles() if len(ids) >= _ENOUGH else [])
    turn = next((way for way in ways[:2] if _likeness(_along(axes, documented, way))[0] > _ALIKE), None)
    if turn is None:
        turn = max(ways, key=lambda way: _likeness(_along(axes, documented, way)))
    along = _along(axes, documented, turn)
    signs = {name: int(np.sign(value)) if abs(value) > _PARALLEL else 0 for name, value in zip(ids, along, strict=True)}
    # A hand is told by how far it is open, not by the axis of its fingers.
    signs |= {name: 1 for name in ids if name.endswith("Hand")}
    return signs, not np.allclose(turn, np.eye(3))


def _likeness(along: np.ndarray) -> tuple[float, float]:
    """How well axes agree, whichever way they count, and then how many count as NAO's do."""
    return float(np.abs(along).mean()), float(along.sum())


def _along(axes: np.ndarray, documented: np.ndarray, turn: np.ndarray) -> np.ndarray:
    return np.round((axes * (documented @ turn.T)).sum(axis=1), 6)


def _right_angles() -> list[np.ndarray]:
    """Return the 24 rotations by right angles, the one that changes nothing first."""
    found = []
    for order in permutations(range(3)):
        for signs in product((1, -1), repeat=3):
            matrix = np.zeros((3, 3))
            matrix[range(3), order] = signs
            if np.linalg.det(matrix) > 0:
                found.append(matrix)
    return found


def _sets(found: Found) -> dict[str, int]:
    table, counts = joint_table(), {}
    for limits in LIMITS:
        ranges = dict(zip(table.names, table.range_rad(limits), strict=True))
        have = {name: own for name in found.theirs if (own := found.range(name)) is not None}
        counts[limits] = sum(bool(np.abs(own - ranges[name]).max() <= RANGE_RAD) for name, own in have.items())
    return counts
