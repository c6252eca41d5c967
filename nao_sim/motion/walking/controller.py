"""The walking engine on line: the plan, corrected every 20 ms by what the inertial unit feels.

The feet on the floor push against a lean that the plan does not have, with a proportional and a derivative gain on the
torso's orientation and angular velocity, which moves the pressure under the soles towards the side the robot falls to.
Shifting the landing of the swinging foot by the capture point was tried as well; on feet this large it made pushed
robots fall more often, so landings stay where the plan has them.

Everything works on any number of robots at once (a leading batch shape), so that many trials of one walk share one
controller.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.walking.gait import WalkSettings, walk_settings
from nao_sim.motion.walking.plan import WalkPlan
from nao_sim.robot.joints import ACTUATED, joint_table

_ANKLE_PITCH = [ACTUATED.index("LAnklePitch"), ACTUATED.index("RAnklePitch")]
_ANKLE_ROLL = [ACTUATED.index("LAnkleRoll"), ACTUATED.index("RAnkleRoll")]


@dataclass(frozen=True)
class Observation:
    """What the controller knows of the robot, any batch shape (...).

    Attributes:
        lean: roll and pitch of the torso, rad, shape (..., 2).
        gyro: angular velocity about x and y in the torso frame, rad/s, shape (..., 2).
    """

    lean: NDArray[np.float64]
    gyro: NDArray[np.float64]


class WalkController:
    """Plays a plan with feedback; call :meth:`targets` once every control period.

    Args:
        plan: from :func:`nao_sim.motion.walking.plan.plan_walk`.
        settings: gains; None for the package's.
    """

    def __init__(self, plan: WalkPlan, settings: WalkSettings | None = None) -> None:
        self.plan = plan
        self.gains = (settings or walk_settings()).gains
        # Legal whether the robot has the thesis's limits or those of NAO V5.
        self._low, self._high = joint_table().select(ACTUATED).range_rad("envelope").T
        self._tick = 0

    @property
    def done(self) -> bool:
        """Whether the plan has been played."""
        return self._tick >= len(self.plan.times)

    def targets(self, seen: Observation) -> NDArray[np.float64]:
        """Return the next targets of the 25 joints, rad, shape (..., 25).

        After the end of the plan it keeps standing in the last posture, with feedback.
        """
        plan, gains = self.plan, self.gains
        k = min(self._tick, len(plan.times) - 1)
        self._tick += 1
        out = np.broadcast_to(plan.targets[k], (*seen.lean.shape[:-1], len(ACTUATED))).copy()
        on_floor = np.isnan(plan.swing[k]).astype(float)
        roll, pitch = seen.lean[..., 0], seen.lean[..., 1] - plan.lean_rad
        push_pitch = gains.ankle_pitch * pitch + gains.ankle_pitch_rate * seen.gyro[..., 1]
        push_roll = gains.ankle_roll * roll + gains.ankle_roll_rate * seen.gyro[..., 0]
        out[..., _ANKLE_PITCH] += on_floor * push_pitch[..., None]
        out[..., _ANKLE_ROLL] += on_floor * push_roll[..., None]
        return np.clip(out, self._low, self._high)
