"""Krippendorff's alpha at the nominal level, for any number of raters and with gaps."""

from __future__ import annotations

from collections import Counter
from collections.abc import Hashable, Iterable, Sequence
from fractions import Fraction

from nao_sim.game.agreement.measure import Measure

NAME = "Krippendorff's alpha, nominal"


def nominal_alpha(units: Iterable[Sequence[Hashable]]) -> Measure:
    """Return alpha (Krippendorff, Content Analysis, ch. 11): ``1 - observed / expected disagreement``.

    Args:
        units: for each turn the values its raters gave, in any order; None is a gap. Turns with fewer than two values
            say nothing about agreement and are left out.

    Returns:
        The coefficient; not defined where every pairable rating is the same value.
    """
    tallies = [Counter(v for v in values if v is not None) for values in units]
    pairable = [tally for tally in tallies if tally.total() >= 2]
    overall = sum(pairable, Counter[Hashable]())
    n = overall.total()
    unequal = n * n - sum(c * c for c in overall.values())  # ordered pairs of different values over all turns
    if unequal == 0:
        return Measure.undefined(NAME, len(pairable), len(pairable))
    within = sum(
        Fraction(tally.total() ** 2 - sum(c * c for c in tally.values()), tally.total() - 1) for tally in pairable
    )
    return Measure.of(NAME, float(1 - (n - 1) * within / unequal))
