"""The proof that a model keeps NAO's documented limits: drive every joint to both ends and measure.

Works on our model and on any other MJCF that uses NAOqi's joint names and takes angles as control.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from nao_sim.robot.command import CommandLayer
from nao_sim.robot.errors import RobotError
from nao_sim.robot.joints import ACTUATED, BODY, Joint, joint_table
from nao_sim.robot.model import FIXED_HEIGHT_M, model_spec

PERIOD_S = 0.02
REST_MRAD, PEAK_MRAD = 1.0, 5.0
"""How far a measured angle may pass its limit, at rest and in passing: MuJoCo's limits are soft."""

SPEED_RATIO = 1.02
"""Greatest measured speed over the motor's nominal speed."""

REACH_DEG = 1.0
"""How near a joint must come to the end it was sent to, against its own weight."""

_RANGE_RAD = 1e-5
_SETTLE_PERIODS = 25


@dataclass(frozen=True)
class JointReport:
    """What one joint did; angles in degrees (hands: per cent open), torques in Nm, speeds in degrees a second.

    Attributes:
        documented, compiled, commanded, reached: lower and upper ends; commanded ones respect the anti-collision
            tables, None where the model lacks the joint or its motor.
        rest_mrad, peak_mrad: how far the limit was passed at rest and in passing.
        speed, nominal_speed: greatest measured speed, and the motor's.
        torque, torque_limit: greatest motor torque, and its limit.
        problems: what is wrong, empty when all is well.
    """

    joint: str
    documented: tuple[float, float]
    compiled: tuple[float, float] | None
    commanded: tuple[float, float] | None
    reached: tuple[float, float] | None
    rest_mrad: float | None
    peak_mrad: float | None
    speed: float | None
    nominal_speed: float
    torque: float | None
    torque_limit: float
    problems: tuple[str, ...]

    def as_dict(self) -> dict[str, Any]:
        """Return the report as plain values."""
        return asdict(self)


@dataclass(frozen=True)
class _Run:
    """Measurements of one joint over a run to both ends; radians."""

    commanded: tuple[float, float]
    reached: tuple[float, float]
    rest: float
    peak: float
    speed: float
    torque: float
    stable: bool


def hung_up(mjcf: Path | None = None, limits: str = "thesis") -> mujoco.MjModel:
    """Compile our model, or the MJCF at a path, with the torso fixed in the air and contacts off.

    Raises:
        RobotError: the file is not a model MuJoCo can compile.
    """
    if mjcf is None:
        spec = model_spec(limits, base="fixed")
    else:
        try:
            spec = mujoco.MjSpec.from_file(str(mjcf))
        except Exception as error:  # MuJoCo raises ValueError and its own errors alike
            raise RobotError(f"{mjcf} is not an MJCF that MuJoCo reads: {error}") from error
        for key in list(spec.keys):
            spec.delete(key)
        for joint in [j for j in spec.joints if j.type == mujoco.mjtJoint.mjJNT_FREE]:
            joint.parent.pos = [0, 0, FIXED_HEIGHT_M]
            spec.delete(joint)
    spec.option.disableflags |= int(mujoco.mjtDisableBit.mjDSBL_CONTACT)
    try:
        return spec.compile()
    except Exception as error:
        raise RobotError(f"{mjcf} does not compile with its base fixed: {error}") from error


def validate_model(mjcf: Path | None = None, limits: str = "thesis") -> list[JointReport]:
    """Drive every joint of a model to both ends of its documented range and report, in NAOqi's order.

    Args:
        mjcf: somebody's model; None is ours.
        limits: the limit set to hold it to, ``"thesis"`` or ``"v5"``.
    """
    model = hung_up(mjcf, limits)
    return list(_reports(model, limits))


def _reports(model: mujoco.MjModel, limits: str) -> Iterator[JointReport]:
    table = joint_table()
    ranges = table.range_rad(limits)
    for joint, documented in zip(table.joints, ranges, strict=True):
        yield _report(model, joint, documented, limits)


def _report(model: mujoco.MjModel, joint: Joint, documented: np.ndarray, limits: str) -> JointReport:
    unit = 100.0 if joint.name.endswith("Hand") else 180 / np.pi
    compiled = _compiled_range(model, joint.name)
    motor = joint.follows or joint.name
    run = _run(model, joint.name, motor, limits) if compiled is not None and _actuator(model, motor) >= 0 else None

    def scaled(pair: Any) -> tuple[float, float] | None:
        return None if pair is None else (float(pair[0] * unit), float(pair[1] * unit))

    return JointReport(
        joint=joint.name,
        documented=(float(documented[0] * unit), float(documented[1] * unit)),
        compiled=scaled(compiled),
        commanded=scaled(run.commanded if run else None),
        reached=scaled(run.reached if run else None),
        rest_mrad=run.rest * 1e3 if run else None,
        peak_mrad=run.peak * 1e3 if run else None,
        speed=run.speed * unit if run else None,
        nominal_speed=joint.nominal_speed * unit,
        torque=run.torque if run else None,
        torque_limit=joint.effort_nm,
        problems=tuple(_problems(joint, documented, compiled, run)),
    )


def _problems(joint: Joint, documented: np.ndarray, compiled: np.ndarray | None, run: _Run | None) -> Iterator[str]:
    if compiled is None:
        yield "no such joint, or no range"
        return
    if np.abs(compiled - documented).max() > _RANGE_RAD:
        yield "range differs from the documented one"
    if run is None:
        yield "no motor"
        return
    if not run.stable:
        yield "the simulation becomes unstable"
        return
    reach = 0.01 if joint.name.endswith("Hand") else np.radians(REACH_DEG)
    if np.abs(np.subtract(run.reached, run.commanded)).max() > reach:
        yield "does not reach the end it was sent to"
    if run.rest > REST_MRAD * 1e-3:
        yield f"rests {run.rest * 1e3:.1f} mrad past its limit"
    if run.peak > PEAK_MRAD * 1e-3:
        yield f"passes its limit by {run.peak * 1e3:.1f} mrad"
    if run.speed > SPEED_RATIO * joint.nominal_speed:
        yield f"turns at {run.speed / joint.nominal_speed:.2f} times its motor's nominal speed"
    if run.torque > joint.effort_nm * 1.001:
        yield f"its motor gives {run.torque:.2f} Nm"


def _compiled_range(model: mujoco.MjModel, name: str) -> np.ndarray | None:
    joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
    return model.jnt_range[joint].copy() if joint >= 0 and model.jnt_limited[joint] else None


def _actuator(model: mujoco.MjModel, joint: str) -> int:
    """Return the id of the actuator that turns a joint, or -1."""
    target = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, joint)
    driven = (model.actuator_trntype == mujoco.mjtTrn.mjTRN_JOINT) & (model.actuator_trnid[:, 0] == target)
    found = np.flatnonzero(driven) if target >= 0 else np.array([], dtype=int)
    return int(found[0]) if found.size else -1


def _run(model: mujoco.MjModel, joint: str, motor: str, limits: str) -> _Run:
    """Send one motor to the upper end, the lower end and home, and watch its joint at every time step."""
    data = mujoco.MjData(model)
    command = CommandLayer(limits, PERIOD_S)
    zeros = np.clip(np.zeros(len(ACTUATED)), command.low, command.high)
    command.reset(zeros)
    rows = [(row, _actuator(model, name)) for row, name in enumerate(ACTUATED)]
    wired = [(row, actuator) for row, actuator in rows if actuator >= 0]
    row, own = ACTUATED.index(motor), _actuator(model, motor)
    address, dof = model.joint(joint).qposadr[0], model.joint(joint).dofadr[0]
    for source, name in enumerate(ACTUATED):
        if mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name) >= 0:
            data.joint(name).qpos[0] = zeros[source]
    low, high = joint_table().range_rad(limits)[BODY.index(joint)]
    steps = max(1, round(PERIOD_S / model.opt.timestep))
    peak = speed = torque = 0.0
    ends: list[tuple[float, float]] = []
    for end in (command.high[row], command.low[row]):
        targets = zeros.copy()
        targets[row] = end
        command.set_all(targets)
        waited = 0
        while waited < _SETTLE_PERIODS:
            start = command.setpoint
            change = command.advance() - start
            waited = waited + 1 if not change.any() else 0
            for k in range(steps):
                for source, actuator in wired:
                    data.ctrl[actuator] = start[source] + change[source] * k / steps
                mujoco.mj_step(model, data)
                angle = data.qpos[address]
                peak = max(peak, angle - high, low - angle)
                speed = max(speed, abs(data.qvel[dof]))
                torque = max(torque, abs(data.actuator_force[own]))
        ends.append((float(command.setpoint[row]), float(data.qpos[address])))
    (top, reached_top), (bottom, reached_bottom) = ends
    rest = max(reached_top - high, low - reached_bottom, 0.0)
    stable = bool(np.isfinite(data.qpos).all()) and not data.warning.number.any()
    return _Run((bottom, top), (reached_bottom, reached_top), rest, peak, speed, torque, stable)
