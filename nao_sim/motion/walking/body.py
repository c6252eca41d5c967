"""The whole body on the planned feet: torso over the centre of mass, and the zero moment point it really makes."""

from __future__ import annotations

import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.trajectory import CONTROL_PERIOD
from nao_sim.motion.walking.leg_kinematics import LEG_COLUMNS, solve_legs
from nao_sim.robot.joints import ACTUATED
from nao_sim.robot.model import model_spec
from nao_sim.robot.placement import place
from nao_sim.robot.postures import posture

STANCE = "StandInit"
_PASSES = 3
_SHOULDERS = np.array([ACTUATED.index("LShoulderPitch"), ACTUATED.index("RShoulderPitch")])


class WalkingBody:
    """The model of the plan: documented masses, rigid fingers, no floor.

    Attributes:
        pitch: the torso's lean in StandInit, rad, kept while walking.
        com_height: height of the centre of mass in StandInit, m.
        com_ahead: how far it is ahead of the soles' origins, m.
        targets: StandInit, shape (25,).
    """

    def __init__(self) -> None:
        self.model = model_spec(fingers=False, scene=False).compile()
        self.model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT | mujoco.mjtDisableBit.mjDSBL_CONSTRAINT
        self.data = mujoco.MjData(self.model)
        stance = posture(STANCE)
        place(self.model, self.data, stance)
        self.targets = np.array([stance[name] for name in ACTUATED])
        w, x, y, z = self.data.qpos[3:7]
        self.pitch = float(np.arcsin(2 * (w * y - z * x)))
        self._torso = self.data.qpos[:3].copy()
        self._address = np.array([self.model.joint(name).qposadr[0] for name in ACTUATED])
        self._coupled = int(self.model.joint("RHipYawPitch").qposadr[0])
        soles = (self.data.site("l_sole").xpos + self.data.site("r_sole").xpos) / 2
        com = self.data.subtree_com[1] - soles
        self.com_ahead, self.com_height = float(com[0]), float(com[2])
        self._torso_over_com = self._torso - soles - com

    def carry(
        self, feet: NDArray[np.float64], com: NDArray[np.float64], ahead: NDArray[np.float64]
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64]]:
        """Return joints and torso that put the centre of mass over the plan.

        Args:
            feet: soles, shape (n, 2, 4).
            com: centre of mass, m, shape (n, 3).
            ahead: ShoulderPitch to add on the left and take away on the right, rad, shape (n,).

        Returns:
            Targets, shape (n, 25), torso origins, m, shape (n, 3), and the torso's headings, rad, shape (n,).
        """
        targets = np.tile(self.targets, (len(com), 1))
        targets[:, _SHOULDERS] += ahead[:, None] * [1.0, -1.0]
        torso = com + self._torso_over_com
        lean = np.full(len(com), self.pitch)
        for _ in range(_PASSES):
            targets[:, LEG_COLUMNS], heading = solve_legs(torso, np.zeros(len(com)), lean, feet)
            torso = torso + com - self._centres_of_mass(self._configurations(targets, torso, heading))
        targets[:, LEG_COLUMNS], heading = solve_legs(torso, np.zeros(len(com)), lean, feet)
        return targets, torso, heading

    def zero_moment_point(
        self, targets: NDArray[np.float64], torso: NDArray[np.float64], heading: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        """Return the zero moment point that the moving body makes, m, shape (n, 2), by inverse dynamics."""
        q = self._configurations(targets, torso, heading)
        n, nv = len(q), self.model.nv
        velocity = np.zeros((n, nv))
        for k in range(1, n - 1):
            mujoco.mj_differentiatePos(self.model, velocity[k], 2 * CONTROL_PERIOD, q[k - 1], q[k + 1])
        acceleration = np.gradient(velocity, CONTROL_PERIOD, axis=0)
        points = np.empty((n, 2))
        for k in range(n):
            self.data.qpos[:], self.data.qvel[:], self.data.qacc[:] = q[k], velocity[k], acceleration[k]
            mujoco.mj_inverse(self.model, self.data)
            force = self.data.qfrc_inverse[:3]
            # The free joint's torque is in the torso's frame and about its origin.
            torque = self.data.xmat[1].reshape(3, 3) @ self.data.qfrc_inverse[3:6] + np.cross(q[k, :3], force)
            points[k] = [-torque[1] / force[2], torque[0] / force[2]]
        return points

    def _configurations(
        self, targets: NDArray[np.float64], torso: NDArray[np.float64], heading: NDArray[np.float64]
    ) -> NDArray[np.float64]:
        q = np.tile(self.data.qpos, (len(targets), 1))
        q[:, :3] = torso
        half_p, half_h = self.pitch / 2, heading / 2
        # Heading about z, then lean about y.
        q[:, 3], q[:, 4] = np.cos(half_h) * np.cos(half_p), -np.sin(half_h) * np.sin(half_p)
        q[:, 5], q[:, 6] = np.cos(half_h) * np.sin(half_p), np.sin(half_h) * np.cos(half_p)
        q[:, self._address] = targets
        q[:, self._coupled] = targets[:, ACTUATED.index("LHipYawPitch")]
        return q

    def _centres_of_mass(self, q: NDArray[np.float64]) -> NDArray[np.float64]:
        out = np.empty((len(q), 3))
        for k, configuration in enumerate(q):
            self.data.qpos[:] = configuration
            mujoco.mj_kinematics(self.model, self.data)
            mujoco.mj_comPos(self.model, self.data)
            out[k] = self.data.subtree_com[1]
        return out
