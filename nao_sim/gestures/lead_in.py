"""The way to a motion's first pose: no part of the motion, and given the time that the motors need."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nao_sim.gestures.key_frames import KeyFrame
from nao_sim.motion.limits import asked_over_able, bounds
from nao_sim.motion.trajectory import Trajectory
from nao_sim.robot.joints import ACTUATED

# A joint so near its first key frame is there with the next set-point: measured poses differ so from asked ones.
_SAME_RAD = 0.01
# Of a movement of d in T: greatest speed at most 3 d / T (a cubic that runs on through its end), greatest acceleration
# about 6 d / T².
_PEAK_SPEED, _PEAK_ACCELERATION = 3.0, 6.0
# Where the file leaves too little time it gets enough for balance, too.
_COMFORT_S, _COMFORT = 1.0, 1.5


def lacking_s(frames: list[KeyFrame], even: Trajectory) -> float:
    """Return the seconds that are missing on the way to the pose in which each joint is named first; 0: none.

    Args:
        frames: in order of time.
        even: the motion made of them, every 20 ms, from where the robot is.
    """
    first: dict[str, tuple[float, float]] = {}
    for frame in frames:
        for name, value in frame.angles_rad.items():
            first.setdefault(name, (frame.time_s, value))
    ratio, lacking = asked_over_able(even), 0.0
    for name, (time_s, value) in first.items():
        column = ACTUATED.index(name)
        distance = abs(value - float(even.targets[0, column]))
        # Intervals that end before the first key frame are the way there.
        way = ratio[even.times[1:] <= time_s + 1e-9, column]
        if distance >= _SAME_RAD and (not len(way) or way.max() > 1.0):
            lacking = max(lacking, _comfortable_s(column, distance) - time_s)
    return lacking


def later(frames: list[KeyFrame], by_s: float) -> list[KeyFrame]:
    """Return the key frames, all later: what moves together goes on moving together."""
    return [replace(frame, time_s=frame.time_s + by_s) for frame in frames]


def _comfortable_s(column: int, distance: float) -> float:
    bound = bounds()
    by_speed = _PEAK_SPEED * distance / float(bound.speed[column])
    by_acceleration = float(np.sqrt(_PEAK_ACCELERATION * distance / bound.acceleration[column]))
    return max(_COMFORT * max(by_speed, by_acceleration), _COMFORT_S)
