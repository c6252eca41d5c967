"""How well the body did what it was asked."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from nao_sim.motion import MotionLog

_MOVING_RAD = np.radians(2.0)
"""A joint whose target travels at least this far counts as moving."""


@dataclass(frozen=True)
class Outcome:
    """Figures of one motion.

    Attributes:
        fell: whether the robot fell.
        fell_at_s: when, seconds from the start of the motion; None if it did not.
        tracking_rms_deg: root mean square of target minus measured angle over time and the moving joints.
        tracking_worst_deg: the largest such difference, and
        tracking_worst_joint: the joint it was in; both over all joints but the hands.
        torso_tilt_max_deg: the torso's largest angle from the vertical.
        torso_tilt_end_deg: the same at the end of the motion.
        duration_s: length of the motion.
    """

    fell: bool
    fell_at_s: float | None
    tracking_rms_deg: float
    tracking_worst_deg: float
    tracking_worst_joint: str
    torso_tilt_max_deg: float
    torso_tilt_end_deg: float
    duration_s: float


def torso_tilt_rad(torso_pose: np.ndarray) -> np.ndarray:
    """Angle between the torso's z axis and the vertical.

    Args:
        torso_pose: position [m] and quaternion (w, x, y, z) in the world frame, shape (n, 7).

    Returns:
        Radians, shape (n,).
    """
    _, x, y, _ = torso_pose[:, 3:].T
    return np.arccos(np.clip(1.0 - 2.0 * (x * x + y * y), -1.0, 1.0))


def moving_joints(targets: np.ndarray, names: tuple[str, ...]) -> list[str]:
    """Names of the joints whose target travels, the widest travel first (hands count by their opening)."""
    travel = np.ptp(targets, axis=0)
    return [names[j] for j in np.argsort(-travel, kind="stable") if travel[j] >= _MOVING_RAD]


def measure(log: MotionLog, names: tuple[str, ...]) -> Outcome:
    """Measure a motion.

    Args:
        log: what was commanded and what happened.
        names: the actuated joints, in the order of the log's columns.
    """
    angular = np.array([not name.endswith("Hand") for name in names])
    error_deg = np.degrees(np.abs(log.targets - log.angles)) * angular
    moving = [names.index(name) for name in moving_joints(log.targets, names) if not name.endswith("Hand")]
    rms = float(np.sqrt(np.mean(error_deg[:, moving or np.flatnonzero(angular)] ** 2)))
    worst = np.unravel_index(np.argmax(error_deg), error_deg.shape)
    tilt_deg = np.degrees(torso_tilt_rad(log.torso_pose))
    return Outcome(
        fell=bool(log.fallen),
        fell_at_s=log.fell_at,
        tracking_rms_deg=rms,
        tracking_worst_deg=float(error_deg[worst]),
        tracking_worst_joint=names[worst[1]],
        torso_tilt_max_deg=float(tilt_deg.max()),
        torso_tilt_end_deg=float(tilt_deg[-1]),
        duration_s=float(log.time[-1] - log.time[0]),
    )
