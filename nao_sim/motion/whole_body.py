"""Whole-body inverse kinematics of a standing robot: feet planted, centre of mass over them.

Given what arms and head do and how the torso shall lean, this finds the legs. Each moment is a small quadratic program
(mink): both soles stay where they are in StandInit, the centre of mass stays above the point it has there, the torso
takes the orientation and height asked for, and the coupled HipYawPitch stays at zero. Dynamics are left to the on-line
feedback of :mod:`nao_sim.motion.balance`.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import mink
import mujoco
import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nao_sim.motion.errors import MotionError
from nao_sim.robot.joints import ACTUATED, BODY, joint_table
from nao_sim.robot.model import model_spec
from nao_sim.robot.postures import posture

STANCE = "StandInit"
LEG_JOINTS = tuple(name for name in ACTUATED if any(part in name for part in ("Hip", "Knee", "Ankle")))
SOLES = ("l_sole", "r_sole")
_MOST_STEPS = 12
_STILL = 1e-5
# A sole further than this from its place, or a centre of mass from its own, is not a solution (metres).
_TOLERANCE_M = 0.004


@dataclass(frozen=True)
class TorsoPath:
    """Where the torso is at each of n moments.

    Attributes:
        pitch: rad about y, 0 upright, positive forward, shape (n,).
        roll: rad about x, positive to the robot's right, shape (n,).
        height: m above its height in StandInit, shape (n,).
    """

    pitch: NDArray[np.float64]
    roll: NDArray[np.float64]
    height: NDArray[np.float64]


class _Stance:
    """The kinematic problem, built once: model, tasks and the place of feet and centre of mass."""

    def __init__(self) -> None:
        self.model = model_spec(fingers=False, scene=False).compile()
        self.configuration = mink.Configuration(self.model)
        self.address = {name: self.model.joint(name).qposadr[0] for name in BODY}
        self.home_q = self._home()
        self.configuration.update(self.home_q)
        self.feet = [mink.FrameTask(sole, "site", position_cost=100.0, orientation_cost=30.0) for sole in SOLES]
        for task in self.feet:
            task.set_target_from_configuration(self.configuration)
        self.com = mink.ComTask(cost=[20.0, 20.0, 0.0])
        self.com.set_target_from_configuration(self.configuration)
        self.torso = mink.FrameTask("torso", "body", position_cost=[0.0, 0.0, 2.0], orientation_cost=[1.0, 1.0, 0.0])
        self.torso_home = self.configuration.get_transform_frame_to_world("torso", "body")
        legs = [name for name in BODY if name in (*LEG_JOINTS, "RHipYawPitch") and not name.endswith("HipYawPitch")]
        free = {self.model.joint(name).dofadr[0] for name in legs} | set(range(6))
        self.frozen = mink.DofFreezingTask(self.model, [dof for dof in range(self.model.nv) if dof not in free])
        self.low, self.high = joint_table().select(ACTUATED).range_rad().T
        self.limits = [mink.ConfigurationLimit(self.model)]

    def _home(self) -> NDArray[np.float64]:
        """Return qpos of the stance, with the soles level on the floor."""
        data = mujoco.MjData(self.model)
        for name in BODY:
            data.qpos[self.address[name]] = posture(STANCE)[name]
        mujoco.mj_kinematics(self.model, data)
        sole = data.site(SOLES[0])
        level = Rotation.from_matrix(sole.xmat.reshape(3, 3)).inv()
        torso = Rotation.from_quat(data.qpos[3:7], scalar_first=True)
        data.qpos[3:7] = (level * torso).as_quat(scalar_first=True)
        mujoco.mj_kinematics(self.model, data)
        data.qpos[:3] -= [*((data.site(SOLES[0]).xpos + data.site(SOLES[1]).xpos)[:2] / 2), sole.xpos[2]]
        return data.qpos.copy()

    def solve(self, targets: NDArray[np.float64], pitch: float, roll: float, height: float) -> NDArray[np.float64]:
        """Return the leg angles, shape (len(LEG_JOINTS),); starts from the solution before."""
        q = self.configuration.q.copy()
        # What lies outside a range is for the checks to find; here it only has to have a stance.
        targets = np.clip(targets, self.low, self.high)
        for column, name in enumerate(ACTUATED):
            if name not in LEG_JOINTS:
                q[self.address[name]] = targets[column]
        self.configuration.update(q)
        place = self.torso_home.translation() + np.array([0.0, 0.0, height])
        turned = Rotation.from_euler("YX", [pitch, roll]).as_quat(scalar_first=True)
        self.torso.set_target(mink.SE3.from_rotation_and_translation(mink.SO3(turned), place))
        tasks = [*self.feet, self.com, self.torso]
        for _ in range(_MOST_STEPS):
            step = mink.solve_ik(
                self.configuration, tasks, 1.0, "daqp", damping=1e-6, limits=self.limits, constraints=[self.frozen]
            )
            self.configuration.integrate_inplace(step, 1.0)
            if np.abs(step).max() < _STILL:
                break
        return np.array([self.configuration.q[self.address[name]] for name in LEG_JOINTS])

    def error(self) -> float:
        """Return how far a sole or the centre of mass is from its place, m."""
        far = [np.abs(task.compute_error(self.configuration)[:3]).max() for task in self.feet]
        return float(max(*far, np.abs(self.com.compute_error(self.configuration)[:2]).max()))


@cache
def _stance() -> _Stance:
    return _Stance()


def standing_torso() -> tuple[float, float]:
    """Return the torso's pitch (rad) and height above the soles (m) in StandInit."""
    home = _stance().torso_home
    pitch = Rotation.from_quat(home.rotation().wxyz, scalar_first=True).as_euler("YXZ")[0]
    return float(pitch), float(home.translation()[2])


def plant_feet(times: NDArray[np.float64], targets: NDArray[np.float64], torso: TorsoPath) -> NDArray[np.float64]:
    """Return targets whose legs carry the rest with both feet planted.

    Args:
        times: seconds, shape (n,).
        targets: rad, shape (n, 25); the leg columns are replaced.
        torso: where the torso shall be, n moments.

    Raises:
        MotionError: no stance does that; says when.
    """
    stance = _stance()
    stance.configuration.update(stance.home_q)
    legs = np.empty((len(times), len(LEG_JOINTS)))
    for sample, time in enumerate(times):
        where = torso.pitch[sample], torso.roll[sample], torso.height[sample]
        legs[sample] = stance.solve(targets[sample], *map(float, where))
        if stance.error() > _TOLERANCE_M:
            raise MotionError(
                f"no stance with both feet planted at {time:.2f} s for torso pitch "
                f"{np.rad2deg(where[0]):.0f} deg, roll {np.rad2deg(where[1]):.0f} deg; ask the torso for less"
            )
    out = targets.copy()
    out[:, [ACTUATED.index(name) for name in LEG_JOINTS]] = legs
    return out
