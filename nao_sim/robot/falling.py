"""Is the robot down? Asked every control period, so a fall is known within 20 ms."""

from __future__ import annotations

import mujoco
import numpy as np

TILT_RAD = np.radians(85)
"""A torso that leans further is falling even before it touches; the bow of the library leans 66 with the feet flat."""

_FEET = ("l_foot", "r_foot")


class FallDetector:
    """Tells standing from lying: nothing but the feet may bear on the world, and the torso must be upright.

    After a reset into a posture that sits or lies by design the robot is not called fallen; from the moment it has
    stood on its feet alone, it can fall.
    """

    def __init__(self, model: mujoco.MjModel) -> None:
        robot = {b for b in range(model.nbody) if model.body_rootid[b] == model.body("torso").id}
        feet = {model.body(name).id for name in _FEET}
        # World 0, feet 3, the rest of the robot 1: only a body part on the world adds up to 1.
        self._kind = [3 if b in feet else 1 if b in robot else 0 for b in model.geom_bodyid.tolist()]
        self._torso = model.body("torso").id
        self._upright = float(np.cos(TILT_RAD))
        self._fixed = model.joint(0).type[0] != mujoco.mjtJoint.mjJNT_FREE
        self._armed = True

    def reset(self, stands: bool) -> None:
        """Start anew; ``stands`` is False for a posture that sits or lies by design."""
        self._armed = stands

    def fallen(self, data: mujoco.MjData) -> bool:
        """Return whether the robot is down now."""
        if self._fixed:
            return False
        down = bool(data.xmat[self._torso, 8] < self._upright) or self._body_contact(data)
        self._armed = self._armed or not down
        return down and self._armed

    def _body_contact(self, data: mujoco.MjData) -> bool:
        # A handful of contacts: plain lists are faster than arrays.
        kind = self._kind
        return any(kind[a] + kind[b] == 1 for a, b in data.contact.geom.tolist())
