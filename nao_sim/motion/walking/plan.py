"""From footsteps to a motion: feet, zero moment point, centre of mass, torso, against time.

Everything is in the frame of the stance at the start: x forward, y left, origin on the floor midway between the
soles. A step is a double support, in which the zero moment point goes over to the standing foot, and a single support,
in which the other foot swings. The centre of mass follows by preview control. Then the torso is placed so that the
centre of mass of the whole body, legs and arms included, is where the plan has it; and because a body is not a point,
the zero moment point that its limbs really make is computed and the difference previewed once more (Kajita's second
pass).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.trajectory import CONTROL_PERIOD
from nao_sim.motion.walking.body import WalkingBody
from nao_sim.motion.walking.footsteps import LEFT, Footstep, beside, footsteps
from nao_sim.motion.walking.gait import Gait, WalkSettings, walk_settings
from nao_sim.motion.walking.preview import cart_table, follow


@dataclass(frozen=True, eq=False)
class WalkPlan:
    """A walk without disturbances, sampled every control period.

    Attributes:
        times: s, shape (n,).
        feet: x, y, z (m) and heading (rad) of the soles' origins, left first, shape (n, 2, 4).
        support: share of the weight that the zero moment point puts on each foot, shape (n, 2).
        swing: 0 … 1 how far the foot in the air has come, NaN for a foot on the floor, shape (n, 2).
        zmp: the reference, m, shape (n, 2).
        com: centre of mass, m, shape (n, 3).
        torso: torso origin, m, shape (n, 3).
        heading: of the torso, rad, shape (n,).
        targets: the 25 joints without feedback, rad, shape (n, 25).
        lean_rad: the torso's pitch throughout, that of StandInit.
        steps: the footsteps.
    """

    times: NDArray[np.float64]
    feet: NDArray[np.float64]
    support: NDArray[np.float64]
    swing: NDArray[np.float64]
    zmp: NDArray[np.float64]
    com: NDArray[np.float64]
    torso: NDArray[np.float64]
    heading: NDArray[np.float64]
    targets: NDArray[np.float64]
    lean_rad: float
    steps: tuple[Footstep, ...]


def plan_walk(x: float, y: float, turn: float, settings: WalkSettings | None = None) -> WalkPlan:
    """Plan a walk from StandInit to StandInit.

    Args:
        x, y: where to, forward and to the left, m.
        turn: heading at the end, to the left, rad.
        settings: gait and preview weights; None for the package's.
    """
    settings = settings or walk_settings()
    steps = footsteps(x, y, turn, settings.gait)
    body = WalkingBody()
    feet, swing, reference, support = _feet_and_zmp(steps, settings.gait, body.com_ahead)
    model = cart_table(body.com_height - settings.gait.lower_m, CONTROL_PERIOD, settings.preview)
    com = np.column_stack([follow(model, reference)[0][:, 0], _height(len(feet), body.com_height, settings.gait)])
    arms = settings.gait.arm_swing_rad_m * (feet[:, 0, :2] - feet[:, 1, :2])
    heading = feet[:, :, 3].mean(axis=1)
    ahead = arms[:, 0] * np.cos(heading) + arms[:, 1] * np.sin(heading) if len(steps) else np.zeros(len(feet))
    targets, torso, torso_heading = body.carry(feet, com, ahead)
    made = body.zero_moment_point(targets, torso, torso_heading)
    missing = reference - made
    missing[0] = 0.0  # the robot stands still at the start
    com[:, :2] += follow(model, missing)[0][:, 0]
    targets, torso, torso_heading = body.carry(feet, com, ahead)
    times = np.arange(len(feet), dtype=np.float64) * CONTROL_PERIOD
    return WalkPlan(
        times, feet, support, swing, reference, com, torso, torso_heading, targets, body.pitch, tuple(steps)
    )


def _height(count: int, standing: float, gait: Gait) -> NDArray[np.float64]:
    """Return the height of the centre of mass, m, shape (n,): bent knees while walking, StandInit at both ends."""
    settle = round(gait.settle_s / CONTROL_PERIOD)
    into = np.clip(np.arange(count) / settle, 0.0, 1.0)
    share = np.minimum(into, into[::-1])
    return standing - gait.lower_m * share**3 * (10 - 15 * share + 6 * share * share)


def _feet_and_zmp(
    steps: list[Footstep], gait: Gait, com_ahead: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
    """Return feet (n, 2, 4), swing (n, 2), the zero moment point (n, 2) and the support shares (n, 2)."""
    settle = round(gait.settle_s / CONTROL_PERIOD)
    period = round(gait.step_s / CONTROL_PERIOD)
    double = round(gait.double_support * gait.step_s / CONTROL_PERIOD)
    count = 2 * settle + len(steps) * period + double
    feet = np.zeros((count, 2, 4))
    swing = np.full((count, 2), np.nan)
    support = np.full((count, 2), 0.5)
    origin = np.zeros(3)
    here = [np.array([s.x, s.y, 0.0, s.heading]) for s in (beside(origin, foot, gait) for foot in (0, 1))]
    feet[:] = here
    for number, step in enumerate(steps):
        start = settle + number * period
        air = slice(start + double, start + period)
        share = (np.arange(period - double) + 1.0) / (period - double)
        goal = np.array([step.x, step.y, 0.0, step.heading])
        feet[air, step.foot] = _swing(here[step.foot], goal, share, gait.foot_lift_m)
        feet[air.stop :, step.foot] = goal
        swing[air, step.foot] = share
        before = support[start - 1].copy()
        standing = np.eye(2)[1 - step.foot]
        over = ((np.arange(double) + 1.0) / (double + 1.0))[:, None]
        support[start : start + double] = before + over * (standing - before)
        support[air] = standing
        support[air.stop :] = standing
        here[step.foot] = goal
    if steps:
        last = settle + len(steps) * period
        over = np.clip((np.arange(count - last) + 1.0) / (double + 1.0), 0.0, 1.0)[:, None]
        support[last:] = support[last - 1] + over * (0.5 - support[last - 1])
    return feet, swing, _zmp(feet, support, gait, com_ahead), support


def _zmp(feet: NDArray[np.float64], support: NDArray[np.float64], gait: Gait, com_ahead: float) -> NDArray[np.float64]:
    """Return the reference: under the standing foot, a little ahead of and inside its ankle."""
    places = np.empty((len(feet), 2, 2))
    for foot in (0, 1):
        heading = feet[:, foot, 3]
        inward = -gait.zmp_inset_m if foot == LEFT else gait.zmp_inset_m
        places[:, foot, 0] = feet[:, foot, 0] + com_ahead * np.cos(heading) - inward * np.sin(heading)
        places[:, foot, 1] = feet[:, foot, 1] + com_ahead * np.sin(heading) + inward * np.cos(heading)
    return np.einsum("nf,nfd->nd", support, places)


def _swing(
    start: NDArray[np.float64], goal: NDArray[np.float64], share: NDArray[np.float64], lift: float
) -> NDArray[np.float64]:
    """Return a foot's way through the air, shape (m, 4): it rises before it moves and has arrived before it lands."""
    s = np.clip((share - 0.12) / 0.76, 0.0, 1.0)
    smooth = s**3 * (10 - 15 * s + 6 * s * s)
    path = start + smooth[:, None] * (goal - start)
    path[:, 2] = lift * np.sin(np.pi * share) ** 2
    return path
