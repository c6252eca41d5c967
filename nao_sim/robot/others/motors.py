"""What a model's actuators take: angles, or something that no range can be tried with."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np

_JOINT = (mujoco.mjtTrn.mjTRN_JOINT, mujoco.mjtTrn.mjTRN_JOINTINPARENT)
_POSITION_INPUT = 1  # bit of actuator_ctrlspec


@dataclass(frozen=True)
class Drive:
    """An actuator that turns a joint.

    Attributes:
        actuator: its id.
        kind: what it is, in MJCF's words.
        takes: what its control means: ``"angle"``, ``"speed"``, ``"torque"``, or what else.
        ctrl: where its control is in ``data.ctrl``.
        gear: control for a joint angle of one.
        reach: least and greatest joint angle that its control range lets through.
    """

    actuator: int
    kind: str
    takes: str
    ctrl: int
    gear: float
    reach: tuple[float, float]


def drive_of(model: mujoco.MjModel, joint: int) -> Drive | None:
    """Return what turns a joint, the actuator that takes angles where there are several; None: nothing does."""
    turns = np.isin(model.actuator_trntype, _JOINT) & (model.actuator_trnid[:, 0] == joint)
    found = [_drive(model, int(actuator)) for actuator in np.flatnonzero(turns)]
    return next((drive for drive in found if drive.takes == "angle"), found[0] if found else None)


def _drive(model: mujoco.MjModel, actuator: int) -> Drive:
    kind, takes = _kind(model, actuator)
    gear = float(model.actuator_gear[actuator, 0])
    ctrl = int(model.actuator_ctrladr[actuator])
    reach = (-np.inf, np.inf)
    if model.actuator_ctrllimited[actuator] and gear:
        ends = model.actuator_ctrlrange[actuator] / gear
        reach = (float(ends.min()), float(ends.max()))
    return Drive(actuator, kind, takes, ctrl, gear, reach)


def _kind(model: mujoco.MjModel, actuator: int) -> tuple[str, str]:
    """Return an actuator's kind and what it takes."""
    gain, bias = model.actuator_gainprm[actuator], model.actuator_biasprm[actuator]
    gain_type, bias_type = model.actuator_gaintype[actuator], model.actuator_biastype[actuator]
    dynamics, inputs = model.actuator_dyntype[actuator], int(model.actuator_ctrlspec[actuator])
    if gain_type == mujoco.mjtGain.mjGAIN_DCMOTOR:
        if not inputs & _POSITION_INPUT:
            return "dcmotor", "speed" if inputs & 2 else "voltage"
        return "dcmotor", "angle" if gain[4] > 0 else "angles, but has no controller"
    if gain_type == mujoco.mjtGain.mjGAIN_PID:
        return "pid", "angle" if inputs & _POSITION_INPUT else "speed"
    if gain_type == mujoco.mjtGain.mjGAIN_MUSCLE:
        return "muscle", "activation"
    if gain_type != mujoco.mjtGain.mjGAIN_FIXED:
        return "general", "something else"
    if bias_type == mujoco.mjtBias.mjBIAS_NONE:
        return "motor", "torque"
    if bias_type == mujoco.mjtBias.mjBIAS_AFFINE and dynamics == mujoco.mjtDyn.mjDYN_INTEGRATOR:
        return "intvelocity", "speed"
    if bias_type == mujoco.mjtBias.mjBIAS_AFFINE and bias[0] == 0:
        if gain[0] > 0 and np.isclose(bias[1], -gain[0]):
            return "position", "angle"
        if bias[1] == 0 and np.isclose(bias[2], -gain[0]):
            return "velocity", "speed"
    return "general", "something else"
