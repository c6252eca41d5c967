"""The motions of ``assets/motions/get_up_*.toml`` as trajectories."""

from __future__ import annotations

import tomllib
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.errors import MotionError
from nao_sim.motion.getting_up.lying import Lie
from nao_sim.motion.limits import bounds
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.resources import resource
from nao_sim.robot import ACTUATED
from nao_sim.robot.postures import posture

GOAL = "StandInit"
_SPEED_SHARE = 0.98  # of the motors' nominal speed


@cache
def _key_frames(lie: Lie) -> tuple[tuple[float, dict[str, float]], ...]:
    """Return each key frame's duration, s, and its angles by motor, rad."""
    rows = tomllib.loads(resource("assets", "motions", f"get_up_{lie.value}.toml").read_text("utf-8"))["key_frame"]
    return tuple((float(row["duration_s"]), _angles(row)) for row in rows)


def _angles(row: dict[str, Any]) -> dict[str, float]:
    angles = {}
    for joint, degrees in (row.get("arms_deg", {}) | row.get("legs_deg", {})).items():
        if joint in ACTUATED:
            angles[joint] = float(np.deg2rad(degrees))
            continue
        # Mirrored at the sagittal plane, rotations about x and z change sign; HipYawPitch is one motor for both.
        sign = -1.0 if joint.endswith(("Roll", "Yaw")) else 1.0
        for name, value in ((f"L{joint}", degrees), (f"R{joint}", sign * degrees)):
            if name in ACTUATED:
                angles[name] = float(np.deg2rad(value))
    return angles


def get_up_trajectory(lie: Lie, start: NDArray[np.float64]) -> Trajectory:
    """Return the way from lying to StandInit, every 20 ms.

    Args:
        lie: ``Lie.BELLY`` or ``Lie.BACK``.
        start: where the set-points are, rad, shape (25,).

    Raises:
        MotionError: the robot is upright.
    """
    if lie is Lie.UPRIGHT:
        raise MotionError("the robot is upright; it need not get up")
    frames = _key_frames(lie)
    poses, durations = [np.array(start, dtype=float)], []
    for duration, angles in frames:
        pose = poses[-1].copy()
        for joint, angle in angles.items():
            pose[ACTUATED.index(joint)] = angle
        poses.append(pose)
        durations.append(duration)
    poses[-1] = np.array([posture(GOAL)[name] for name in ACTUATED])
    stack = np.array(poses)
    # Smoothstep is 1.5 times as fast in its middle as on average; a start far away is given the time it takes.
    least = 1.5 * (np.abs(np.diff(stack, axis=0)) / (_SPEED_SHARE * bounds().speed)).max(axis=1)
    times = np.concatenate([[0.0], np.cumsum(np.maximum(durations, least))])
    at = np.arange(1, int(np.ceil(times[-1] / CONTROL_PERIOD)) + 1) * CONTROL_PERIOD
    after = np.clip(np.searchsorted(times, at), 1, len(frames))
    share = (at - np.take(times, after - 1)) / (np.take(times, after) - np.take(times, after - 1))
    # Every key frame is a rest: contacts change there, and each is waited for.
    eased = np.clip(share, 0, 1) ** 2 * (3 - 2 * np.clip(share, 0, 1))
    targets = stack[after - 1] + eased[:, None] * (stack[after] - stack[after - 1])
    return Trajectory(np.concatenate([[0.0], at]), np.concatenate([stack[:1], targets]))
