"""Where the feet go: from a displacement to a row of footsteps.

The way to the goal is one constant twist (the exponential map of SE(2)), so every step is the same small displacement in
the robot's own frame: straight lines, side steps, turns on the spot and arcs are one case. Forward progress is made by
every step; sideways progress and turning by the foot on that side, and the other foot follows, so that the feet never
cross.
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
    """Return the pose ``(x, y, heading)`` after a share (0 … 1) of the constant twist that leads to ``(x, y, turn)``."""
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

    The last two steps put the feet side by side at the goal.

    Args:
        x: forward, m.
        y: to the left, m.
        turn: to the left, rad.
        gait: step lengths.
    """
    strides = number_of_strides(x, y, turn, gait)
    if strides == 0:
        return []
    sideways, turning = abs(y) / gait.most_sideways_m, abs(turn) / gait.most_turn_rad
    to_the_left = (y > 0) if sideways >= turning else (turn > 0)
    leading = LEFT if to_the_left or (y == 0 and turn == 0) else RIGHT
    steps = []
    for stride in range(strides):
        first, second = (stride + 0.5) / strides, (stride + 1.0) / strides
        # Sideways and heading are those of the stride's end for both feet; forward they share the way.
        end = along_twist(x, y, turn, second)
        middle = along_twist(x, y, turn, first)
        lead = end.copy()
        ahead = np.array([np.cos(end[2]), np.sin(end[2])])
        lead[:2] -= ahead * (ahead @ (end[:2] - middle[:2]))
        steps += [beside(lead, leading, gait), beside(end, 1 - leading, gait)]
    last = along_twist(x, y, turn, 1.0)
    if np.hypot(*(steps[-2].x - beside(last, leading, gait).x, steps[-2].y - beside(last, leading, gait).y)) > 1e-9:
        steps.append(beside(last, leading, gait))
    return steps
