"""Where the robot is in a compiled scene: found by its joints' names, whatever stands before it or is put before them.

``MjSpec.attach`` gives every name of the robot a prefix and a suffix, and a scene may hold several robots, balls and
tables; nothing here relies on the robot being first.
"""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

from nao_sim.robot.errors import SceneError
from nao_sim.robot.joints import ACTUATED, BODY

_MARK = "HeadYaw"
_SHOWN = 4


@dataclass(frozen=True, eq=False)
class Wiring:
    """One robot's rows and addresses in a model.

    Attributes:
        model: the compiled scene.
        prefix, suffix: what the scene puts around each of the robot's names.
        torso: its body's id.
        bodies: ``(nbody,)`` which bodies are the robot's.
        geoms: ``(ngeom,)`` which geoms are.
        qpos, dof: ``(25,)`` addresses of the joints that have motors.
        motors, ctrl: ``(25,)`` ids of the actuators, and their places in ``data.ctrl``.
        root: the free joint's id, or None where the torso hangs on something.
    """

    model: mujoco.MjModel
    prefix: str
    suffix: str
    torso: int
    bodies: np.ndarray
    geoms: np.ndarray
    qpos: np.ndarray
    dof: np.ndarray
    motors: np.ndarray
    ctrl: np.ndarray
    root: int | None

    def named(self, name: str) -> str:
        """Return what the scene calls a part of the robot."""
        return f"{self.prefix}{name}{self.suffix}"

    def id(self, kind: mujoco.mjtObj, name: str) -> int:
        """Return the id of one of the robot's bodies, sites, sensors …

        Raises:
            SceneError: the scene has left it out.
        """
        found = mujoco.mj_name2id(self.model, kind, self.named(name))
        if found < 0:
            what = kind.name.removeprefix("mjOBJ_").lower()
            raise SceneError(
                f"the robot in this scene has no {what} '{self.named(name)}'; put in the robot of "
                "nao_sim.robot.model_spec(), or try another one's with 'nao-sim validate --model --mjcf FILE'"
            )
        return int(found)

    def joint(self, name: str) -> int:
        """Return a joint's id."""
        return self.id(mujoco.mjtObj.mjOBJ_JOINT, name)

    def body(self, name: str) -> int:
        """Return a body's id."""
        return self.id(mujoco.mjtObj.mjOBJ_BODY, name)

    def site(self, name: str) -> int:
        """Return a site's id."""
        return self.id(mujoco.mjtObj.mjOBJ_SITE, name)

    def sensor(self, name: str) -> int:
        """Return the place of a sensor's first number in ``data.sensordata``."""
        return int(self.model.sensor_adr[self.id(mujoco.mjtObj.mjOBJ_SENSOR, name)])


def affixes(model: mujoco.MjModel) -> list[tuple[str, str]]:
    """Return prefix and suffix of every robot in a model: around each joint name that holds ``HeadYaw``.

    Where some have all joints of a NAO, the others are left out.
    """
    names = {model.joint(k).name for k in range(model.njnt)}
    parted = [name.rpartition(_MARK) for name in sorted(names) if _MARK in name]
    found = [(before, after) for before, _, after in parted]
    return [(before, after) for before, after in found if {before + j + after for j in BODY} <= names] or found


def find_robot(model: mujoco.MjModel, prefix: str | None = None) -> Wiring:
    """Find the robot in a compiled scene.

    Args:
        model: the scene.
        prefix: which one, where there are several: what stands before its names (or after them).

    Raises:
        SceneError: no robot, none of that prefix, several to choose from, or one that lacks joints or motors.
    """
    found = affixes(model)
    if not found:
        raise SceneError(
            f"there is no NAO in this scene: no joint is called '{_MARK}', with or without a prefix; put in the robot "
            "of nao_sim.robot.model_spec()"
        )
    chosen = [pair for pair in found if prefix in (None, pair[0] or pair[1])]
    labels = ", ".join(f"'{before or after}'" for before, after in found)
    if not chosen:
        raise SceneError(f"no NAO of the prefix '{prefix}' is in this scene; prefixes there: {labels}")
    if len(chosen) > 1:
        raise SceneError(f"this scene has {len(chosen)} NAOs; say which with prefix=: {labels}")
    return _wire(model, *chosen[0])


def _wire(model: mujoco.MjModel, prefix: str, suffix: str) -> Wiring:
    joints = {name: mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, f"{prefix}{name}{suffix}") for name in BODY}
    missing = [name for name, joint in joints.items() if joint < 0]
    if missing:
        raise SceneError(f"the NAO in this scene lacks joints: {_some(missing)}; it needs all {len(BODY)}")
    motors = {name: motor_of(model, joints[name]) for name in ACTUATED}
    idle = [name for name, motor in motors.items() if motor < 0]
    if idle:
        raise SceneError(f"the NAO in this scene has no motors for {_some(idle)}; it needs all {len(ACTUATED)}")
    torso = int(model.body_parentid[model.jnt_bodyid[joints[_MARK]]])
    bodies = subtree(model, torso)
    rows = np.array([joints[name] for name in ACTUATED])
    ids = np.array(list(motors.values()))
    first = int(model.body_jntadr[torso])
    free = first >= 0 and model.jnt_type[first] == mujoco.mjtJoint.mjJNT_FREE
    return Wiring(
        model=model,
        prefix=prefix,
        suffix=suffix,
        torso=torso,
        bodies=bodies,
        geoms=bodies[model.geom_bodyid],
        qpos=model.jnt_qposadr[rows],
        dof=model.jnt_dofadr[rows],
        motors=ids,
        ctrl=model.actuator_ctrladr[ids],
        root=first if free else None,
    )


def _some(names: list[str]) -> str:
    return ", ".join(names[:_SHOWN]) + (f" and {len(names) - _SHOWN} more" if len(names) > _SHOWN else "")


def motor_of(model: mujoco.MjModel, joint: int) -> int:
    """Return the id of the first actuator that turns a joint, or -1."""
    kinds = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
    turns = np.isin(model.actuator_trntype, kinds) & (model.actuator_trnid[:, 0] == joint)
    found = np.flatnonzero(turns) if joint >= 0 else np.array([], dtype=int)
    return int(found[0]) if found.size else -1


def subtree(model: mujoco.MjModel, root: int) -> np.ndarray:
    """Return ``(nbody,)`` which bodies hang on a body, itself included; children come after their parents."""
    member = np.zeros(model.nbody, dtype=bool)
    member[root] = True
    for body in range(root + 1, model.nbody):
        member[body] = member[model.body_parentid[body]]
    return member
