"""The proof that a model keeps NAO's documented limits: drive every joint to both ends and measure.

Works on our model and on other people's: what :mod:`nao_sim.robot.others` finds in theirs is compared where it can be
compared and driven where it takes angles; the rest is "not measured", and no number is given for it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

import mujoco
import numpy as np

from nao_sim.robot.command import CommandLayer
from nao_sim.robot.joints import ACTUATED, BODY, Joint, joint_table
from nao_sim.robot.model import model_spec
from nao_sim.robot.others.found import RANGE_RAD, Found, look, of_spec
from nao_sim.robot.others.motors import Drive

PERIOD_S = 0.02
REST_MRAD, PEAK_MRAD = 1.0, 5.0
"""How far a measured angle may pass its limit, at rest and in passing: MuJoCo's limits are soft."""

SPEED_RATIO = 1.02
"""Greatest measured speed over the motor's nominal speed."""

REACH_DEG = 1.0
"""How near a joint must come to the end it was sent to, against its own weight."""

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
        theirs: what the model calls the joint, None where it has none.
        actuator: kind of actuator that turns it, None where nothing does.
        unmeasured: why nothing was measured although the joint is there; empty where it was.
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
    theirs: str | None = None
    actuator: str | None = None
    unmeasured: str = ""

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


def validate_model(mjcf: Path | None = None, limits: str = "thesis", found: Found | None = None) -> list[JointReport]:
    """Drive every joint of a model to both ends of its documented range and report, in NAOqi's order.

    Args:
        mjcf: somebody's model; None is ours.
        limits: the limit set to hold it to, ``"thesis"``, ``"v5"`` or ``"envelope"``.
        found: what was found in it, where that is known already.

    Raises:
        RobotError: the file is no model with joints of a NAO.
    """
    if found is None:
        found = of_spec(model_spec(limits)) if mjcf is None else look(mjcf)
    table = joint_table()
    ranges = table.range_rad(limits)
    return [_report(found, joint, documented, limits) for joint, documented in zip(table.joints, ranges, strict=True)]


def _report(found: Found, joint: Joint, documented: np.ndarray, limits: str) -> JointReport:
    unit = 100.0 if joint.name.endswith("Hand") else 180 / np.pi
    there = joint.name in found.theirs
    compiled = found.range(joint.name) if there else None
    motor = joint.follows if joint.follows and joint.name not in found.drives else joint.name
    drive = found.drives.get(motor)
    why = _unmeasured(found, joint.name, drive) if there else ""
    run = _run(found, joint.name, motor, limits) if there and drive is not None and not why else None

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
        problems=tuple(_problems(found, joint, documented, compiled, drive, run)),
        theirs=found.theirs.get(joint.name),
        actuator=drive.kind if there and drive is not None else None,
        unmeasured=why,
    )


def _unmeasured(found: Found, joint: str, drive: Drive | None) -> str:
    """Say why a joint that is there cannot be driven to angles; empty: it can."""
    if drive is None:
        return "nothing drives it"
    if drive.takes != "angle":
        return f"its {drive.kind} takes {drive.takes}, not angles"
    if found.signs[joint] == 0:
        return "it turns about another axis than NAO's"
    if found.read.weightless:
        return "the model's masses are not known"
    return ""


def _problems(
    found: Found,
    joint: Joint,
    documented: np.ndarray,
    compiled: np.ndarray | None,
    drive: Drive | None,
    run: _Run | None,
) -> Iterator[str]:
    if joint.name not in found.theirs:
        yield "no such joint, or no range"
        return
    if found.signs[joint.name] == 0:
        yield "turns about another axis than the documented one"
    if compiled is None:
        yield "has no range"
    elif np.abs(compiled - documented).max() > RANGE_RAD:
        yield "range differs from the documented one"
    if drive is None:
        yield "no motor"
    if run is None or drive is None:
        return
    if not run.stable:
        yield "the simulation becomes unstable"
        return
    sign = found.signs[joint.name]
    reach = sorted(sign * end for end in drive.reach)
    if reach[0] > run.commanded[0] + RANGE_RAD or reach[1] < run.commanded[1] - RANGE_RAD:
        yield "its control range does not let all of the range through"
    least = 0.01 if joint.name.endswith("Hand") else np.radians(REACH_DEG)
    if np.abs(np.subtract(run.reached, run.commanded)).max() > least:
        yield "does not reach the end it was sent to"
    if run.rest > REST_MRAD * 1e-3:
        yield f"rests {run.rest * 1e3:.1f} mrad past its limit"
    if run.peak > PEAK_MRAD * 1e-3:
        yield f"passes its limit by {run.peak * 1e3:.1f} mrad"
    if run.speed > SPEED_RATIO * joint.nominal_speed:
        yield f"turns at {run.speed / joint.nominal_speed:.2f} times its motor's nominal speed"
    if run.torque > joint.effort_nm * 1.001:
        yield f"its motor gives {run.torque:.2f} Nm"


def _run(found: Found, joint: str, motor: str, limits: str) -> _Run:
    """Send one motor to the upper end, the lower end and home, and watch its joint at every time step."""
    model = found.read.model
    data = mujoco.MjData(model)
    command = CommandLayer(limits, PERIOD_S)
    zeros = np.clip(np.zeros(len(ACTUATED)), command.low, command.high)
    command.reset(zeros)
    wired = [(ACTUATED.index(n), found.drives[n], found.signs[n] or 1) for n in ACTUATED if _driven(found, n)]
    row = ACTUATED.index(joint_table()[motor].follows or motor)
    own, sign = found.drives[motor], found.signs[joint]
    address, dof = model.jnt_qposadr[found.joint(joint)], model.jnt_dofadr[found.joint(joint)]
    if motor not in ACTUATED:
        wired.append((row, own, sign))
    for source, name in enumerate(ACTUATED):
        if name in found.theirs:
            data.qpos[model.jnt_qposadr[found.joint(name)]] = zeros[source] * (found.signs[name] or 1)
    low, high = joint_table().range_rad(limits)[BODY.index(joint)]
    peak = speed = torque = 0.0
    ends: list[tuple[float, float]] = []
    for end in (command.high[row], command.low[row]):
        targets = zeros.copy()
        targets[row] = end
        command.set_all(targets)
        waited = period = 0
        begun = data.time
        while waited < _SETTLE_PERIODS:
            start = command.setpoint
            change = command.advance() - start
            waited = waited + 1 if not change.any() else 0
            period += 1
            # As many steps as simulated time takes, whether or not they divide the period.
            while (share := (data.time - begun) / PERIOD_S - period + 1) < 1 - 1e-9:
                for source, drive, way in wired:
                    data.ctrl[drive.ctrl] = way * drive.gear * (start[source] + change[source] * share)
                mujoco.mj_step(model, data)
                angle = sign * data.qpos[address]
                peak = max(peak, angle - high, low - angle)
                speed = max(speed, abs(data.qvel[dof]))
                torque = max(torque, abs(data.actuator_force[own.actuator] * own.gear))
        ends.append((float(command.setpoint[row]), float(sign * data.qpos[address])))
    (top, reached_top), (bottom, reached_bottom) = ends
    rest = max(reached_top - high, low - reached_bottom, 0.0)
    stable = bool(np.isfinite(data.qpos).all()) and not data.warning.number.any()
    return _Run((bottom, top), (reached_bottom, reached_top), rest, peak, speed, torque, stable)


def _driven(found: Found, name: str) -> bool:
    return name in found.drives and found.drives[name].takes == "angle"
