"""Is the robot down? Asked every control period, so a fall is known within 20 ms.

Down is who lies, and who has stood and now bears on the ground with more than the feet. A touch is no fall: a hand on
a table, a ball at the shin, a shoulder at the wall; nor is a seat above the ground, with the torso upright.
"""

from __future__ import annotations

import mujoco
import numpy as np

from nao_sim.robot.postures import Posture
from nao_sim.robot.wiring import Wiring

TILT_RAD = np.radians(85)
"""A torso that leans further is falling even before it touches; the bow of the library leans 66 with the feet flat."""

LEAN_RAD = np.radians(45)
"""A torso that leans further, with the weight on more than the feet, lies on something."""

BEARING_SHARE = 0.1
"""So much of its weight on more than the feet is bearing, not touching."""

GROUND_M = 0.05
"""What is lower above the ground under the feet is the ground, too; a seat is higher."""

_FEET = ("l_foot", "r_foot")
_OTHER, _BODY, _FOOT = 0, 1, 2


class FallDetector:
    """Tells standing, sitting and touching from lying and falling.

    After a reset into a posture that sits or lies by design the robot is not called fallen; from the moment it has
    stood on its feet alone, it can fall. One that was set down sitting falls when it topples.
    """

    def __init__(self, wiring: Wiring) -> None:
        model = self._model = wiring.model
        feet = {wiring.body(name) for name in _FEET}
        robot = wiring.bodies
        # The last entry is for contacts of what is no geom (flexible bodies), whose id is -1.
        self._kind = [_FOOT if b in feet else _BODY if robot[b] else _OTHER for b in model.geom_bodyid.tolist()]
        self._kind.append(_OTHER)
        self._torso = wiring.torso
        self._fixed = wiring.root is None
        gravity = float(np.linalg.norm(model.opt.gravity))
        self._bearing_n = BEARING_SHARE * float(model.body_mass[robot].sum()) * gravity
        self._upright, self._leaning = float(np.cos(TILT_RAD)), float(np.cos(LEAN_RAD))
        self._ground = 0.0
        self._armed = self._lies_by_design = False

    def reset(self, posture: Posture, ground: float) -> None:
        """Start anew in a posture, with the ground under the robot at a height in m."""
        self._armed = posture.torso is None
        self._lies_by_design = posture.torso is not None and abs(posture.torso[1]) > LEAN_RAD
        self._ground = ground

    def fallen(self, data: mujoco.MjData) -> bool:
        """Return whether the robot is down now, and not by design."""
        if self._fixed:
            return False
        low, bearing, feet = self._load(data)
        lies = self._lies(data, bearing)
        if feet > 5 * self._bearing_n and bearing == 0.0 and not lies:
            self._armed = True
        if self._armed:
            return lies or low > self._bearing_n
        return lies and not self._lies_by_design

    def lies(self, data: mujoco.MjData) -> bool:
        """Return whether the robot lies now, by design or not."""
        return not self._fixed and self._lies(data, self._load(data)[1])

    def _lies(self, data: mujoco.MjData, bearing: float) -> bool:
        up = float(data.xmat[self._torso, 8])
        return up < self._upright or (up < self._leaning and bearing > self._bearing_n)

    def _load(self, data: mujoco.MjData) -> tuple[float, float, float]:
        """Return the force in N on the body low down, on the body in all, and on the feet; note the ground's height."""
        # A handful of contacts: plain lists are faster than arrays.
        kind, low, bearing, feet, ground = self._kind, 0.0, 0.0, 0.0, None
        for index, (a, b) in enumerate(data.contact.geom.tolist()):
            one, two = kind[a], kind[b]
            if (one == _OTHER) == (two == _OTHER):
                continue
            part = one + two
            if part == _FOOT and self._armed:
                height = float(data.contact[index].pos[2])
                ground = height if ground is None else min(ground, height)
                continue
            force, height = self._upward(data, index, two != _OTHER)
            if part == _FOOT:
                feet += force
                continue
            bearing += force
            if height <= self._ground + GROUND_M:
                low += force
        if ground is not None:
            self._ground = ground
        return low, bearing, feet

    def _upward(self, data: mujoco.MjData, index: int, second: bool) -> tuple[float, float]:
        """Return how hard a contact holds the robot up, N, 0 where it presses from the side or above, and its height.

        Args:
            data: the state.
            index: of the contact.
            second: the robot's geom is the second one, towards which the contact's normal points.
        """
        contact = data.contact[index]
        rise = float(contact.frame[2]) if second else -float(contact.frame[2])
        if rise < 0.5:
            return 0.0, float(contact.pos[2])
        force = np.zeros(6)
        mujoco.mj_contactForce(self._model, data, index, force)
        return float(force[0]) * rise, float(contact.pos[2])
