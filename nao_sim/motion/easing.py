"""How a joint gets from key frame to key frame.

Every easing passes through every key frame, and between two key frames a joint never goes beyond the two values, so
key frames inside the range make a motion inside the range. The two smooth ones come to rest at every turning point,
because their slopes are those of the monotone cubic of Fritsch and Carlson (1980).

``minimum_jerk``
    Quintic pieces with zero acceleration at the key frames. From rest to rest this is the minimum-jerk movement of
    Flash and Hogan (1985), which people's arm movements resemble.
``cubic``
    Cubic pieces. They turn round at full acceleration, as a waving hand or a nodding head does, instead of dwelling.
``linear``
    Straight lines, as Webots, NAOqi's ``angleInterpolation`` and recordings join their samples.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import BPoly, CubicHermiteSpline, PchipInterpolator

Easing = Literal["minimum_jerk", "cubic", "linear"]
EASINGS: tuple[str, ...] = get_args(Easing)


def ease(
    key_times: NDArray[np.float64], values: NDArray[np.float64], at: NDArray[np.float64], easing: Easing
) -> NDArray[np.float64]:
    """Return one joint's values at the times ``at``.

    Args:
        key_times: times of the key frames, strictly increasing, seconds, shape (k,).
        values: the joint's value at each, any unit, shape (k,).
        at: times to evaluate, seconds, shape (n,); before the first and after the last key frame the value is held.
        easing: see the module.

    Returns:
        Values, shape (n,), inside ``[min(values), max(values)]``.
    """
    at = np.clip(at, key_times[0], key_times[-1])
    if len(key_times) == 1:
        return np.full(len(at), values[0])
    if easing == "linear":
        return np.interp(at, key_times, values)
    slopes = _rest_at_the_ends(key_times, values)
    if easing == "cubic":
        curve = CubicHermiteSpline(key_times, values, slopes)
    else:
        curve = BPoly.from_derivatives(key_times, np.stack([values, slopes, np.zeros_like(values)], axis=1))
    # The quintic may stray from a steep, uneven pair of pieces by a hair; the promise above is exact.
    return np.clip(curve(at), values.min(), values.max())


def _rest_at_the_ends(key_times: NDArray[np.float64], values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return monotone slopes at the key frames, zero at the first and the last."""
    slopes = np.zeros_like(values)
    if len(values) > 2:
        slopes[1:-1] = PchipInterpolator(key_times, values).derivative()(key_times[1:-1])
    return slopes
