"""The walking engine on line: the plan, corrected every 20 ms by what the inertial unit feels.

Three corrections, all from the torso's lean, heading and angular velocity:

*Ankles.* The feet on the floor push against a lean that the plan does not have, with a proportional and a derivative
gain, which moves the pressure under the soles towards the side the robot falls to.

*Step.* A push shifts the capture point, ξ = x + x'/ω (Pratt et al. 2006); the swinging foot lands as far off its plan
as the capture point is, within limits that keep the feet apart.

*Heading.* A foot that slipped has turned the robot; the next landing is turned back about the standing foot.

Corrected feet carry the rest of the plan with them: each foot has a rigid displacement of the plan, and the torso takes
the mean of both, weighted with the load. Everything works on any number of robots at once (a leading batch shape), so
that many trials of one walk share one controller.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.walking.body import WalkingBody
from nao_sim.motion.walking.gait import WalkSettings, walk_settings
from nao_sim.motion.walking.leg_kinematics import LEG_COLUMNS, solve_legs
from nao_sim.motion.walking.plan import WalkPlan
from nao_sim.motion.walking.preview import GRAVITY
from nao_sim.robot.joints import ACTUATED, joint_table

_ANKLE_PITCH = np.array([ACTUATED.index("LAnklePitch"), ACTUATED.index("RAnklePitch")])
_ANKLE_ROLL = np.array([ACTUATED.index("LAnkleRoll"), ACTUATED.index("RAnkleRoll")])


@dataclass(frozen=True)
class Observation:
    """What the controller knows of the robot, any batch shape (...).

    Attributes:
        lean: roll and pitch of the torso, rad, shape (..., 2).
        yaw: its heading against the start, rad, shape (...).
        gyro: angular velocity about x and y in the torso frame, rad/s, shape (..., 2).
    """

    lean: NDArray[np.float64]
    yaw: NDArray[np.float64]
    gyro: NDArray[np.float64]


class WalkController:
    """Plays a plan with feedback; call :meth:`targets` once every control period.

    Args:
        plan: from :func:`nao_sim.motion.walking.plan.plan_walk`.
        batch: shape of the robots' batch; ``()`` for one robot.
        settings: gains; None for the package's.
    """

    def __init__(self, plan: WalkPlan, batch: tuple[int, ...] = (), settings: WalkSettings | None = None) -> None:
        self.plan = plan
        self.settings = settings or walk_settings()
        self._low, self._high = joint_table().select(ACTUATED).range_rad("envelope").T
        body = WalkingBody()
        self._pitch = body.pitch
        self._height = body.com_height
        self._omega = np.sqrt(GRAVITY / body.com_height)
        self._tick = 0
        # Rigid displacement of the plan for each foot: x, y, heading about the plan's origin.
        self._moved = np.zeros((*batch, 2, 3))
        self._from = self._moved.copy()
        self._capture = np.zeros((*batch, 2))
        self._batch = batch

    @property
    def done(self) -> bool:
        """Whether the plan has been played."""
        return self._tick >= len(self.plan.times)

    def targets(self, seen: Observation) -> NDArray[np.float64]:
        """Return the next targets of the 25 joints, rad, shape (..., 25).

        After the end of the plan it keeps standing in the last posture, with the ankles' feedback.
        """
        plan, k = self.plan, min(self._tick, len(self.plan.times) - 1)
        self._tick += 1
        roll, pitch = seen.lean[..., 0], seen.lean[..., 1] - self._pitch
        self._observe_capture_point(roll, pitch, seen.gyro)
        self._step(k, seen.yaw)
        weight = plan.support[k][:, None]
        feet = np.broadcast_to(plan.feet[k], (*self._batch, 2, 4)).copy()
        feet[..., :2] = displaced(self._moved, plan.feet[k, :, :2])
        feet[..., 3] += self._moved[..., 2]
        torso = np.empty((*self._batch, 3))
        torso[..., :2] = (weight * displaced(self._moved, plan.torso[k, :2])).sum(axis=-2)
        torso[..., 2] = plan.torso[k, 2]
        still = np.zeros(self._batch)
        legs, _ = solve_legs(torso, still, still + self._pitch, feet)
        out = np.broadcast_to(plan.targets[k], (*self._batch, len(ACTUATED))).copy()
        out[..., LEG_COLUMNS] = legs
        self._push_with_ankles(out, k, roll, pitch, seen.gyro)
        return np.clip(out, self._low, self._high)

    def _observe_capture_point(
        self, roll: NDArray[np.float64], pitch: NDArray[np.float64], gyro: NDArray[np.float64]
    ) -> None:
        """Update how far the capture point is off the plan, forward and to the left, m: the body as a stiff pendulum."""
        lean = np.stack([pitch, -roll], axis=-1)
        rate = np.stack([gyro[..., 1], -gyro[..., 0]], axis=-1)
        now = self._height * (lean + rate / self._omega)
        # The rate is full of the steps' own shaking; a first-order filter over about three periods calms it.
        self._capture += 0.3 * (now - self._capture)

    def _step(self, k: int, yaw: NDArray[np.float64]) -> None:
        """Displace the landing of a swinging foot."""
        plan, gains = self.plan, self.settings.gains
        for foot in (0, 1):
            share = plan.swing[k, foot]
            if np.isnan(share):
                continue
            if k == 0 or np.isnan(plan.swing[k - 1, foot]):
                self._from[..., foot, :] = self._moved[..., foot, :]
            if share > gains.freeze:
                continue
            goal = self._landing(k, foot, yaw)
            # Move towards the goal so that it is reached when the landing place freezes.
            left = max(gains.freeze - share, 0.0)
            pace = min(1.0, (plan.swing[k + 1, foot] - share) / left) if left > 0 else 1.0
            self._moved[..., foot, :] += pace * (goal - self._moved[..., foot, :])

    def _landing(self, k: int, foot: int, yaw: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the displacement with which a foot shall land."""
        plan, gains = self.plan, self.settings.gains
        standing = self._moved[..., 1 - foot, :]
        stand_at = plan.feet[k, 1 - foot]
        off = np.clip(gains.heading * (yaw - standing[..., 2] - self.plan.heading[k]), -0.1, 0.1)
        turned = standing.copy()
        turned[..., 2] -= off
        # Turning is about the standing foot, not about the origin.
        turned[..., :2] += displaced(standing, stand_at[:2]) - displaced(turned, stand_at[:2])
        step = gains.step * self._capture
        outward = 1.0 if foot == 0 else -1.0
        step[..., 0] = np.clip(step[..., 0], -gains.most_step_m, gains.most_step_m)
        step[..., 1] = outward * np.clip(outward * step[..., 1], -gains.most_inward_m, gains.most_step_m)
        heading = stand_at[3] + turned[..., 2]
        c, s = np.cos(heading), np.sin(heading)
        turned[..., 0] += c * step[..., 0] - s * step[..., 1]
        turned[..., 1] += s * step[..., 0] + c * step[..., 1]
        return turned

    def _push_with_ankles(
        self,
        out: NDArray[np.float64],
        k: int,
        roll: NDArray[np.float64],
        pitch: NDArray[np.float64],
        gyro: NDArray[np.float64],
    ) -> None:
        gains = self.settings.gains
        loaded = np.isnan(self.plan.swing[k]).astype(float)
        out[..., _ANKLE_PITCH] += (
            loaded * (gains.ankle_pitch * pitch + gains.ankle_pitch_rate * gyro[..., 1])[..., None]
        )
        out[..., _ANKLE_ROLL] += loaded * (gains.ankle_roll * roll + gains.ankle_roll_rate * gyro[..., 0])[..., None]


def displaced(moved: NDArray[np.float64], point: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return points ``(..., 2)`` after rigid displacements ``(..., 3)`` about the origin: turned, then shifted."""
    c, s = np.cos(moved[..., 2]), np.sin(moved[..., 2])
    x, y = point[..., 0], point[..., 1]
    return np.stack([moved[..., 0] + c * x - s * y, moved[..., 1] + s * x + c * y], axis=-1)
