"""Which true differences a permutation test would not reject: the interval by inversion, and equivalence.

Taking a supposed difference d away from the treated children leaves the observed statistic ``D - d`` and each way's
``v - c d``. A way is as extreme as the observed one, ``|v - c d| >= |D - d|``, exactly for d between
``(D - v) / (1 - c)`` and ``(D + v) / (1 + c)``; so p as a function of d is a count of such stretches.
"""

from __future__ import annotations

import numpy as np

from nao_sim.game.statistics.rearrangement import Rearrangements

_DIGITS = 12
"""Ends of stretches that agree so far are one point; outcomes are shares of at most some thousand turns."""


def shift_interval(ways: Rearrangements, confidence: float = 0.95) -> tuple[float, float] | None:
    """Return the smallest and largest difference with ``p > 1 - confidence``.

    Returns:
        The two; None where the design cannot reach so small a p, so that no difference is ever rejected.
    """
    low, high = _stretches(ways)
    everywhere = int(np.count_nonzero(np.isinf(low))) + (not ways.exact)
    need = (1 - confidence) * ways.ways
    if everywhere > need:
        return None
    lows, highs = np.sort(low[np.isfinite(low)]), np.sort(high[np.isfinite(high)])
    # Just at a stretch's beginning it counts already, and one that ends there counts still.
    at_low = everywhere + np.searchsorted(lows, lows, "right") - np.searchsorted(highs, lows, "left")
    at_high = everywhere + np.searchsorted(lows, highs, "right") - np.searchsorted(highs, highs, "left")
    return float(lows[at_low > need][0]), float(highs[at_high > need][-1])


def _stretches(ways: Rearrangements) -> tuple[np.ndarray, np.ndarray]:
    """Return from which to which difference each way is extreme; infinite for the observed way and its mirror."""
    observed = ways.observed / ways.unit
    values = ways.values.astype(float) / ways.unit
    with np.errstate(divide="ignore", invalid="ignore"):
        one = (observed - values) / (1 - ways.slopes)
        two = (observed + values) / (1 + ways.slopes)
    always = np.isclose(np.abs(ways.slopes), 1.0, atol=1e-12)
    ends = np.round(np.sort([one, two], axis=0), _DIGITS) + 0.0
    return np.where(always, -np.inf, ends[0]), np.where(always, np.inf, ends[1])


def equivalence_p(ways: Rearrangements, margin: float) -> float:
    """Return the p value of "the true difference is at least ``margin`` in one direction or the other".

    Two one-sided permutation tests, at -margin and at +margin; the larger of their p values.
    """
    observed = ways.observed / ways.unit
    values = ways.values.astype(float) / ways.unit
    tolerance = 10.0**-_DIGITS
    extra = not ways.exact
    above = np.count_nonzero(values + margin * ways.slopes >= observed + margin - tolerance) + extra
    below = np.count_nonzero(values - margin * ways.slopes <= observed - margin + tolerance) + extra
    return float(max(above, below) / ways.ways)
