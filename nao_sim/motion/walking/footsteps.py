"""Where the feet go: from a displacement to a row of footsteps.

The way to the goal is one constant twist (the exponential map of SE(2)), so every step is the same small displacement
in the robot's own frame: straight lines, side steps, turns on the spot and arcs are one case. Forward progress is made
by every step; sideways progress and turning by the foot on that side, and the other foot follows, so that the feet
never cross.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.walking.gait import Gait

LEFT, RIGHT = 0, 1


@dataclass(frozen=True)
class Footstep:
    """One landing: which foot (0 left, 1 right), where its sole's origin is put (m), and its heading (rad)."""

    foot: int
    x: float
    y: float
    heading: float


def along_twist(x: float, y: float, turn: float, share: float) -> NDArray[np.float64]:
    """Return the pose ``(x, y, heading)`` after a share (0 … 1) of the constant twist to ``(x, y, turn)``."""
    if abs(turn) < 1e-9:
        return np.array([x, y, turn]) * share
    # V maps the twist's linear part to the displacement; V and V⁻¹ at the two ends.
    half = turn / 2
    cot = half / np.tan(half)
    linear = np.array([cot * x + half * y, -half * x + cot * y])
    angle = turn * share
    v = np.array([[np.sin(angle), np.cos(angle) - 1], [1 - np.cos(angle), np.sin(angle)]]) / turn
    return np.array([*(v @ linear), angle])


def beside(pose: NDArray[np.float64], foot: int, gait: Gait) -> Footstep:
    """Return the footstep of a foot of a robot standing in ``pose``."""
    x, y, heading = pose
    offset = gait.stance_width_m / 2 * (1 if foot == LEFT else -1)
    return Footstep(foot, float(x - offset * np.sin(heading)), float(y + offset * np.cos(heading)), float(heading))


def number_of_strides(x: float, y: float, turn: float, gait: Gait) -> int:
    """Return how many strides (two steps each) a displacement takes."""
    twist = along_twist(x, y, turn, 1e-6) * 1e6
    most = np.array([gait.most_forward_m, gait.most_sideways_m, gait.most_turn_rad])
    # Both steps of a stride go forward, only one of them goes sideways or turns.
    forward, sideways, turning = np.abs(twist) / most
    return int(np.ceil(max(forward / 2, sideways + turning) - 1e-6))


def footsteps(x: float, y: float, turn: float, gait: Gait) -> list[Footstep]:
    """Return the footsteps from standing at the origin to standing at ``(x, y)`` with heading ``turn``.

    The last two steps put the feet side by side at the goal. Where step lengths inside the limits would bring the feet
    too close to each other, as on an arc around the outer foot, the strides are made shorter.

    Args:
        x: forward, m.
        y: to the left, m.
        turn: to the left, rad.
        gait: step lengths.
    """
    strides = number_of_strides(x, y, turn, gait)
    if strides == 0:
        return []
    while True:
        steps = _strides(x, y, turn, strides, gait)
        if _least_clearance(steps, gait) >= gait.clearance_m:
            return steps
        strides += 1


def _strides(x: float, y: float, turn: float, strides: int, gait: Gait) -> list[Footstep]:
    # What matters is the way in the robot's own frame: on an arc the heading turns away from a goal straight ahead.
    _, drift, _ = along_twist(x, y, turn, 1e-6) * 1e6
    sideways, turning = drift / gait.most_sideways_m, turn / gait.most_turn_rad
    to_the_left = sideways if abs(sideways) >= abs(turning) else turning
    leading = LEFT if to_the_left >= 0 else RIGHT
    steps = []
    for stride in range(strides):
        # Sideways and heading are those of the stride's end for both feet; forward they share the way.
        middle, end = (along_twist(x, y, turn, (stride + part) / strides) for part in (0.5, 1.0))
        lead = end.copy()
        ahead = np.array([np.cos(end[2]), np.sin(end[2])])
        lead[:2] -= ahead * (ahead @ (end[:2] - middle[:2]))
        steps += [beside(lead, leading, gait), beside(end, 1 - leading, gait)]
    last = beside(along_twist(x, y, turn, 1.0), leading, gait)
    if np.hypot(steps[-2].x - last.x, steps[-2].y - last.y) > 1e-9:
        steps.append(last)
    return steps


def clearance(left: Footstep, right: Footstep, gait: Gait) -> float:
    """Return the distance between two soles along the axes of either, m; negative where they overlap."""
    (back, front), (inside, outside) = gait.sole_x_m, gait.sole_y_m
    box = np.array([[back, -inside], [front, -inside], [front, outside], [back, outside]])
    corners = []
    for foot, sign in ((left, 1), (right, -1)):
        c, s = np.cos(foot.heading), np.sin(foot.heading)
        corners.append(box * [1, sign] @ np.array([[c, s], [-s, c]]) + [foot.x, foot.y])
    gaps = []
    for heading in (left.heading, right.heading):
        c, s = np.cos(heading), np.sin(heading)
        for axis in (np.array([c, s]), np.array([-s, c])):
            a, b = corners[0] @ axis, corners[1] @ axis
            gaps.append(max(a.min() - b.max(), b.min() - a.max()))
    return float(max(gaps))


def _least_clearance(steps: list[Footstep], gait: Gait) -> float:
    feet = [beside(np.zeros(3), foot, gait) for foot in (LEFT, RIGHT)]
    least = np.inf
    for step in steps:
        feet[step.foot] = step
        least = min(least, clearance(feet[LEFT], feet[RIGHT], gait))
    return least
