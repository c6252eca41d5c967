"""How the robot lies, from the direction of gravity in its torso."""

from __future__ import annotations

from enum import Enum

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

# A torso that leans less than this stands (or sits) well enough to be brought upright without lying down first.
UPRIGHT_RAD = float(np.deg2rad(40.0))


class Lie(Enum):
    """What is down: nothing (upright), the belly or the back."""

    UPRIGHT = "upright"
    BELLY = "belly"
    BACK = "back"


def lie_of(torso_quat: NDArray[np.float64]) -> Lie:
    """Return how a torso lies.

    On its side the robot counts as lying on what is lower, belly or back: the arms that come out to the sides at the
    start of either motion turn it over.

    Args:
        torso_quat: orientation in the world, w, x, y, z, shape (4,).
    """
    up = Rotation.from_quat(torso_quat, scalar_first=True).inv().apply([0.0, 0.0, 1.0])
    if up[2] > np.cos(UPRIGHT_RAD):
        return Lie.UPRIGHT
    # The torso's x axis points out of the chest.
    return Lie.BACK if up[0] > 0 else Lie.BELLY
