"""Two conditions compared, children as the unit."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nao_sim.game.statistics.inversion import equivalence_p, shift_interval
from nao_sim.game.statistics.rearrangement import Rearrangements, exchanged_groups, flipped_signs

ALPHA = 0.05
"""A p value up to this one counts as a difference shown; intervals are those of ``1 - ALPHA``."""

FEWEST = 3
"""With fewer children a group (or fewer pairs) there are pictures only."""


@dataclass(frozen=True)
class Comparison:
    """Difference of two conditions.

    Attributes:
        difference: mean of the first condition's children less that of the second's, children unweighted; of pairs
            the mean difference.
        extreme, ways: the two-sided exact p value is extreme / ways.
        exact: whether all ways were counted; else a sample with a fixed seed, the observed one added.
        smallest: the smallest ``extreme`` that the design can reach.
        interval: the differences not rejected at ``ALPHA``; None where the design rejects none.
        margin: the margin of equivalence set beforehand, or None.
        equivalence_p: p of the two one-sided tests against that margin.
        children: how many, in the first and in the second condition; of pairs their number, twice.
    """

    difference: Fraction
    extreme: int
    ways: int
    exact: bool
    smallest: int
    interval: tuple[float, float] | None
    margin: float | None
    equivalence_p: float | None
    children: tuple[int, int]

    @property
    def p(self) -> float:
        """The two-sided p value."""
        return self.extreme / self.ways

    @property
    def smallest_p(self) -> float:
        """The smallest p value that this design can reach with any data."""
        return self.smallest / self.ways


def compare_groups(
    first: Sequence[Fraction],
    second: Sequence[Fraction],
    margin: float | None = None,
    strata: tuple[Sequence[str], Sequence[str]] | None = None,
) -> Comparison | None:
    """Compare two groups of children by the exact permutation of children.

    Args:
        first: each child's outcome, a share between 0 and 1, in the first condition.
        second: in the second.
        margin: of equivalence, set beforehand.
        strata: each child's stratum, for both groups; children change groups only within it.

    Returns:
        The comparison; None with fewer than ``FEWEST`` children in a group.
    """
    if min(len(first), len(second)) < FEWEST:
        return None
    ways = exchanged_groups(first, second, strata)
    return _comparison(ways, margin, (len(first), len(second)))


def compare_pairs(differences: Sequence[Fraction], margin: float | None = None) -> Comparison | None:
    """Compare two conditions that every child went through, by the signs of the children's differences.

    Args:
        differences: each child's outcome in the first condition less that in the second.
        margin: of equivalence, set beforehand.

    Returns:
        The comparison; None with fewer than ``FEWEST`` children.
    """
    if len(differences) < FEWEST:
        return None
    return _comparison(flipped_signs(differences), margin, (len(differences), len(differences)))


def _comparison(ways: Rearrangements, margin: float | None, children: tuple[int, int]) -> Comparison:
    return Comparison(
        difference=Fraction(ways.observed, ways.unit),
        extreme=ways.extreme,
        ways=ways.ways,
        exact=ways.exact,
        smallest=ways.smallest,
        interval=shift_interval(ways, 1 - ALPHA),
        margin=margin,
        equivalence_p=None if margin is None else equivalence_p(ways, margin),
        children=children,
    )
