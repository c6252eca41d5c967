"""How far past a limit an angle still counts as being on it: the softness of the model's own joints.

MuJoCo's limits are soft, so a joint that rests on its stop is measured a little past it. What was measured, rounded to
32 bits or printed with a few digits is therefore no request for more than the joint can do: it is put on the limit.
Everything that judges or takes angles uses this one tolerance.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nao_sim.robot.joints import LIMITS, joint_table

SOFTNESS_RAD = 3e-3
"""How far our model's joints pass their ends when their own motors run them into them (hands: open fraction).

Measured by ``nao-sim validate --model``: 1.9 mrad at most with the thesis's limits, 2.8 with those of NAO V5; at rest
under the body's weight 1.2. The two sets are 5.1 mrad apart where they are nearest.
"""


def on_limits(angles: ArrayLike, low: ArrayLike, high: ArrayLike) -> NDArray[np.float64]:
    """Return a copy of angles with those at most ``SOFTNESS_RAD`` past a limit put on it.

    What is further out, or not a number, is returned as it is, for the caller to refuse.

    Args:
        angles: rad (hands: open fraction), shape (..., n).
        low, high: the limits, shape (n,) or what broadcasts.
    """
    asked = np.array(angles, dtype=float)
    inside = np.clip(asked, low, high)
    return np.where(np.abs(asked - inside) <= SOFTNESS_RAD, inside, asked)


def sets_allowing(joint: str, value: float) -> tuple[str, ...]:
    """Return the names of the limit sets in which a joint may have an angle, rad (hands: open fraction)."""
    allowed = []
    for name in LIMITS:
        low, high = joint_table().select([joint]).range_rad(name)[0]
        if low - SOFTNESS_RAD <= value <= high + SOFTNESS_RAD:
            allowed.append(name)
    return tuple(allowed)


def tell_apart(value: float, *bounds: float, least: int = 2, most: int = 9) -> tuple[str, ...]:
    """Return a value and its bounds as decimals of one length, with digits enough to see which side the value is on.

    Example:
        >>> tell_apart(-0.0004, 0.0, 1.0)
        ('-0.0004', '0.0000', '1.0000')
        >>> tell_apart(95.0, -90.0, 90.0)
        ('95.00', '-90.00', '90.00')
    """
    for digits in range(least, most + 1):
        shown = [f"{number:.{digits}f}" for number in (value, *bounds)]
        if all(float(shown[0]) != float(text) for text, bound in zip(shown[1:], bounds, strict=True) if bound != value):
            break
    return tuple(f"{0.0:.{digits}f}" if float(text) == 0 else text for text in shown)
