"""On-line balance: the torso's orientation, felt every 20 ms, corrects ankles and hips.

A standing robot that is pushed, or whose arms pull it, leans. The feedback turns the ankles against the lean (ankle
strategy) and, in pitch, moves the hips with them (hip strategy; Horak and Nashner, 1986). What counts is the lean
beyond the planned one, which follows from the leg targets because the soles are flat on the floor; so a bow is no
disturbance.

Everything works on rows, one row a robot, so that one robot and a thousand trials run the same code.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nao_sim.motion.trajectory import CONTROL_PERIOD
from nao_sim.robot.joints import ACTUATED

_SQRT_HALF = np.sqrt(0.5)
# Axes of the left leg's joints, torso to foot, in the torso's frame (table of the joints).
_LEFT_LEG = (
    ("LHipYawPitch", (0.0, _SQRT_HALF, -_SQRT_HALF)),
    ("LHipRoll", (1.0, 0.0, 0.0)),
    ("LHipPitch", (0.0, 1.0, 0.0)),
    ("LKneePitch", (0.0, 1.0, 0.0)),
    ("LAnklePitch", (0.0, 1.0, 0.0)),
    ("LAnkleRoll", (1.0, 0.0, 0.0)),
)


@dataclass(frozen=True)
class Gains:
    """Feedback gains: joint offset in rad per rad of lean, per rad·s of it, and per rad/s of its rate.

    They are low on purpose: set-points come late, gears have play, and stiff ankles hold most of it by themselves.
    Larger ones lean less after a push but start to shake the robot with two periods of delay.

    Attributes:
        ankle_pitch, ankle_roll, hip_pitch, hip_roll: (proportional, integral, derivative).
        most_rad: no offset is larger.
        leak_s: the integral forgets with this time constant, seconds.
    """

    ankle_pitch: tuple[float, float, float] = (0.25, 0.2, 0.02)
    ankle_roll: tuple[float, float, float] = (0.20, 0.15, 0.012)
    hip_pitch: tuple[float, float, float] = (0.12, 0.0, 0.005)
    hip_roll: tuple[float, float, float] = (0.08, 0.0, 0.0)
    most_rad: float = 0.20
    leak_s: float = 8.0


_JOINTS = {
    "ankle_roll": ("LAnkleRoll", "RAnkleRoll"),
    "ankle_pitch": ("LAnklePitch", "RAnklePitch"),
    "hip_roll": ("LHipRoll", "RHipRoll"),
    "hip_pitch": ("LHipPitch", "RHipPitch"),
}
_COLUMNS = {part: [ACTUATED.index(name) for name in names] for part, names in _JOINTS.items()}


def planned_lean(targets: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the torso's roll and pitch that the legs ask for with the left sole flat, rad, shape (n, 2).

    Args:
        targets: rad, shape (n, 25).
    """
    foot = Rotation.identity(len(targets))
    for name, axis in _LEFT_LEG:
        foot = foot * Rotation.from_rotvec(targets[:, [ACTUATED.index(name)]] * np.array(axis))
    return lean_of(foot.inv().as_quat(scalar_first=True))


def lean_of(quat: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return roll and pitch, rad, shape (n, 2), of orientations w, x, y, z, shape (n, 4), whatever their heading."""
    w, x, y, z = quat.T
    down_x, down_y, down_z = 2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)
    return np.stack([np.arctan2(down_y, down_z), np.arctan2(-down_x, np.hypot(down_y, down_z))], axis=1)


class Balance:
    """The feedback of n robots.

    Args:
        n: how many.
        gains: see :class:`Gains`.
        period: seconds between updates.
    """

    def __init__(self, n: int = 1, gains: Gains | None = None, period: float = CONTROL_PERIOD) -> None:
        self.gains = gains or Gains()
        self.period = period
        self._integral = np.zeros((n, 2))
        self._before: NDArray[np.float64] | None = None

    def correct(
        self, lean: NDArray[np.float64], rate: NDArray[np.float64], planned: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return offsets to add to the targets, rad, shape (n, 25).

        Args:
            lean: measured roll and pitch of each torso, rad, shape (n, 2).
            rate: measured angular velocity about x and y, rad/s, shape (n, 2).
            planned: the lean that is meant now, rad, shape (n, 2) or (2,).
        """
        gains, planned = self.gains, np.broadcast_to(planned, lean.shape)
        planned_rate = 0.0 if self._before is None else (planned - self._before) / self.period
        self._before = planned
        error, error_rate = lean - planned, rate - planned_rate
        self._integral += self.period * (error - self._integral / gains.leak_s)
        offsets = np.zeros((len(lean), len(ACTUATED)))
        for part, columns in _COLUMNS.items():
            axis = 0 if part.endswith("roll") else 1
            p, i, d = getattr(gains, part)
            push = p * error[:, axis] + i * self._integral[:, axis] + d * error_rate[:, axis]
            offsets[:, columns] = np.clip(push, -gains.most_rad, gains.most_rad)[:, None]
        return offsets
