"""Overlap and trend of one child's phases.

NAP (Parker and Vannest 2009): share of pairs (baseline point, game point) that rise, ties half; the same as
Mann-Whitney's U over the number of pairs. Tau = 2 NAP - 1. A baseline that already rises makes NAP large without any
effect, so its own trend is always given with it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from statistics import median

_HALF = Fraction(1, 2)


@dataclass(frozen=True)
class PhasePair:
    """A baseline and the game phase that follows it.

    Attributes:
        baseline, game: their points, shares between 0 and 1, in time order.
    """

    baseline: tuple[Fraction, ...]
    game: tuple[Fraction, ...]

    @property
    def nap(self) -> Fraction:
        """Non-overlap of all pairs."""
        return nap(self.baseline, self.game)

    @property
    def tau(self) -> Fraction:
        """``2 NAP - 1``."""
        return 2 * self.nap - 1

    @property
    def baseline_tau(self) -> Fraction | None:
        """The baseline's own trend; None with fewer than two points."""
        return trend_tau(self.baseline) if len(self.baseline) > 1 else None

    @property
    def baseline_slope(self) -> Fraction | None:
        """The baseline's slope per point, Theil-Sen; None with fewer than two points."""
        return theil_sen_slope(self.baseline) if len(self.baseline) > 1 else None


def nap(baseline: Sequence[Fraction], game: Sequence[Fraction]) -> Fraction:
    """Return the share of pairs that rise from baseline to game, ties half.

    Raises:
        ValueError: a phase has no points.
    """
    if not baseline or not game:
        raise ValueError("a phase without points overlaps with nothing")
    rising = sum(Fraction(b < g) + _HALF * (b == g) for b in baseline for g in game)
    return Fraction(rising) / (len(baseline) * len(game))


def trend_tau(points: Sequence[Fraction]) -> Fraction:
    """Return Kendall's tau-a of points against their order: (rising - falling pairs) / all pairs.

    Raises:
        ValueError: fewer than two points.
    """
    pairs = list(combinations(points, 2))
    if not pairs:
        raise ValueError("fewer than two points have no trend")
    return Fraction(sum((b > a) - (b < a) for a, b in pairs), len(pairs))


def theil_sen_slope(points: Sequence[Fraction]) -> Fraction:
    """Return the median slope of all pairs of points, per step.

    Raises:
        ValueError: fewer than two points.
    """
    slopes = [Fraction(b - a) / (j - i) for (i, a), (j, b) in combinations(enumerate(points), 2)]
    if not slopes:
        raise ValueError("fewer than two points have no slope")
    return Fraction(median(slopes))
