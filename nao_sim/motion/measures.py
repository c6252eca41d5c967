"""How well a motion was done, and how near it came to what the body allows."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.limits import HANDS, bounds
from nao_sim.motion.perform import MotionLog
from nao_sim.motion.self_distance import nearest_self_distance
from nao_sim.motion.support import com_margins
from nao_sim.motion.trajectory import Trajectory
from nao_sim.robot import ACTUATED, joint_table
from nao_sim.robot.tolerance import on_limits

_ANGLES = [index for index, name in enumerate(ACTUATED) if name not in HANDS]


@dataclass(frozen=True)
class Extreme:
    """The worst value of a kind, the joint or pair it belongs to, and when (seconds)."""

    value: float
    where: str
    time_s: float


@dataclass(frozen=True)
class Measures:
    """One motion, measured.

    Attributes:
        duration_s: of the trajectory.
        range_margin_deg: least distance of a target from its joint's bound; negative is outside (hands left out).
        speed_share: greatest target speed over the motor's nominal speed.
        torque_share: greatest motor torque over the motor's stall torque (datasheet, ideal gear).
        self_distance_mm: least distance between two parts of the body that could touch.
        com_margin_mm: least distance of the centre of mass's ground point from the edge of the support polygon.
        tracking_deg: root mean square of measured minus asked angle, of the worst joint.
        tracking_all_deg: the same over all joints.
        fell_at: seconds, or None.
        ends_standing: upright on both feet after the last target.
        range_use: lowest and highest target of each joint, 0 its lower and 1 its upper bound, shape (25, 2).
    """

    duration_s: float
    range_margin_deg: Extreme
    speed_share: Extreme
    torque_share: Extreme
    self_distance_mm: Extreme
    com_margin_mm: Extreme
    tracking_deg: Extreme
    tracking_all_deg: float
    fell_at: float | None
    ends_standing: bool
    range_use: NDArray[np.float64]


@dataclass(frozen=True)
class Criteria:
    """What a motion must keep to pass; the defaults are those of the library."""

    range_margin_deg: float = 0.0
    speed_share: float = 1.0
    torque_share: float = 1.0
    self_distance_mm: float = 0.0
    com_margin_mm: float = 0.0
    tracking_deg: float = 2.0

    def faults(self, measures: Measures) -> list[str]:
        """Return what is wrong, each a short sentence; empty: the motion passes."""
        found = []
        for name in ("range_margin_deg", "self_distance_mm", "com_margin_mm"):
            extreme, least = getattr(measures, name), getattr(self, name)
            # A target on its bound, or two numbers that differ by rounding, is inside.
            if extreme.value < least - 1e-6:
                found.append(_fault(name, extreme, "below", least))
        for name in ("speed_share", "torque_share", "tracking_deg"):
            extreme, most = getattr(measures, name), getattr(self, name)
            if extreme.value > most + 1e-6:
                found.append(_fault(name, extreme, "above", most))
        if measures.fell_at is not None:
            found.append(f"fell at {measures.fell_at:.2f} s")
        elif not measures.ends_standing:
            found.append("does not end standing")
        return found


def _fault(name: str, extreme: Extreme, side: str, bound: float) -> str:
    return f"{name} {extreme.value:.2f} is {side} {bound:g} ({extreme.where}, {extreme.time_s:.2f} s)"


def measure(
    model: mujoco.MjModel, trajectory: Trajectory, log: MotionLog, limits: str = "thesis", prefix: str | None = None
) -> Measures:
    """Measure a motion from what was asked and what was logged.

    Args:
        model: the model that made the log.
        trajectory: what was asked.
        log: what happened.
        limits: the limit set, as of :func:`nao_sim.motion.limits.bounds`.
        prefix: which robot, where the model has several.
    """
    bound = bounds(limits)
    low, high = bound.range_rad.T
    stall = np.array([joint.stall_torque for joint in joint_table().select(ACTUATED).joints])
    targets = on_limits(trajectory.targets, low, high)
    margin = np.minimum(targets - low, high - targets)[:, _ANGLES]
    errors = (log.angles - log.targets)[:, _ANGLES]
    rms = np.sqrt((errors**2).mean(axis=0))
    distance, pair, when = nearest_self_distance(model, log, prefix)
    com = com_margins(model, log, prefix)
    worst_com = int(np.argmin(com))
    return Measures(
        duration_s=trajectory.duration,
        range_margin_deg=_extreme(np.rad2deg(-margin), trajectory.times, _ANGLES, -1.0),
        speed_share=_extreme(trajectory.speeds() / bound.speed, trajectory.times, range(len(ACTUATED))),
        torque_share=_extreme(np.abs(log.torques) / stall, log.time, range(len(ACTUATED))),
        self_distance_mm=Extreme(1e3 * distance, pair, when),
        com_margin_mm=Extreme(1e3 * float(com[worst_com]), "centre of mass", float(log.time[worst_com])),
        tracking_deg=_worst_joint(np.rad2deg(rms), np.rad2deg(np.abs(errors)), log.time),
        tracking_all_deg=float(np.rad2deg(np.sqrt((errors**2).mean()))),
        fell_at=log.fell_at,
        ends_standing=ends_standing(log),
        range_use=np.stack([(targets.min(axis=0) - low) / (high - low), (targets.max(axis=0) - low) / (high - low)], 1),
    )


def ends_standing(log: MotionLog) -> bool:
    """Return whether the robot is up at the end: no fall, both feet loaded, torso within 25 degrees of upright."""
    _, x, y, _ = log.torso_pose[-1, 3:]
    upright = 1 - 2 * (x * x + y * y) > np.cos(np.deg2rad(25.0))
    feet = log.contacts[-1].reshape(2, 4).sum(axis=1)
    return bool(not log.fallen and upright and (feet > 0.1 * feet.sum()).all() and feet.sum() > 0)


def _extreme(
    values: NDArray[np.float64], times: NDArray[np.float64], columns: list[int] | range, sign: float = 1.0
) -> Extreme:
    """Return the largest of values (rows are times, columns joints) times ``sign``."""
    if values.size == 0:
        return Extreme(0.0, "-", 0.0)
    row, column = np.unravel_index(np.argmax(values), values.shape)
    return Extreme(float(sign * values[row, column]), ACTUATED[columns[column]], float(times[row]))


def _worst_joint(rms: NDArray[np.float64], errors: NDArray[np.float64], times: NDArray[np.float64]) -> Extreme:
    column = int(np.argmax(rms))
    row = int(np.argmax(errors[:, column]))
    return Extreme(float(rms[column]), ACTUATED[_ANGLES[column]], float(times[row]))
