"""All the ways in which a design could have assigned its children, and what each would have shown.

Under "no effect" every assignment that the design allowed was as likely as the one that happened. Values are rational
numbers, so everything that decides a p value is compared in integers.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import combinations
from math import comb, lcm, prod

import numpy as np

ENUMERATED = 200_000
"""Up to so many ways all are counted; beyond it a sample is drawn."""

SAMPLED = 20_000
_SEED = 20070


@dataclass(frozen=True)
class Rearrangements:
    """The statistic of every way.

    Were the effect d for every child, taking it away would leave ``observed - d`` and ``values - d * slopes``.

    Attributes:
        observed: the statistic (a difference of means) as the children really were assigned, as an integer.
        values: the same of every way, integers, shape (ways,).
        unit: how many of these integers are 1.
        slopes: how far taking an effect away shifts each way's statistic, -1 to 1, shape (ways,).
        exact: whether all ways are here; else they are a random sample without the observed one.
        smallest: the smallest number of ways that can be as extreme as the observed one, itself included.
    """

    observed: int
    values: np.ndarray
    unit: int
    slopes: np.ndarray
    exact: bool
    smallest: int

    @property
    def ways(self) -> int:
        """How many ways count, the observed one included."""
        return len(self.values) + (not self.exact)

    @property
    def extreme(self) -> int:
        """How many ways differ at least as much as the observed one, in either direction, itself included."""
        return int(np.count_nonzero(abs(self.values) >= abs(self.observed))) + (not self.exact)

    @property
    def p(self) -> Fraction:
        """The two-sided p value: ``extreme / ways``, differences counted by their size."""
        return Fraction(self.extreme, self.ways)

    @property
    def smallest_p(self) -> Fraction:
        """The smallest p value that this design can reach with any data."""
        return Fraction(self.smallest, self.ways)


def exchanged_groups(
    first: Sequence[Fraction], second: Sequence[Fraction], strata: Sequence[Sequence[str]] | None = None
) -> Rearrangements:
    """Exchange children between two groups: mean of the first less mean of the second, children unweighted.

    Args:
        first: the outcome of each child of the first group.
        second: of the second.
        strata: each child's stratum, first group's then second group's; children change groups only within theirs.
    """
    scaled, unit = _integers([*first, *second])
    n1, n2 = len(first), len(second)
    labels = list(strata[0]) + list(strata[1]) if strata else [""] * (n1 + n2)
    members, exact, smallest = _memberships(np.array(labels), n1)
    sums = members @ scaled
    values = (n1 + n2) * sums - n1 * sum(scaled)
    moved = n1 - members[:, :n1].sum(axis=1)
    slopes = 1 - moved * (1 / n1 + 1 / n2)
    observed = int((n1 + n2) * sum(scaled[:n1]) - n1 * sum(scaled))
    return Rearrangements(observed, values, unit * n1 * n2, slopes, exact, smallest)


def flipped_signs(differences: Sequence[Fraction]) -> Rearrangements:
    """Swap the two conditions within each child: mean of the children's differences."""
    scaled, unit = _integers(differences)
    n = len(differences)
    exact = 2**n <= ENUMERATED
    if exact:
        bits = (np.arange(2**n)[:, None] >> np.arange(n)) & 1
    else:
        bits = np.random.default_rng(_SEED).integers(0, 2, (SAMPLED, n))
    signs = 1 - 2 * bits
    return Rearrangements(int(sum(scaled)), signs @ scaled, unit * n, signs.mean(axis=1), exact, 2 if exact else 1)


def _integers(values: Sequence[Fraction]) -> tuple[np.ndarray, int]:
    """Return the values times their common denominator, and that; Python integers where 64 bits do not suffice."""
    unit = lcm(*(value.denominator for value in values))
    whole = [int(value * unit) for value in values]
    room = sum(abs(w) for w in whole) * 4 * len(whole)
    return np.array(whole, dtype=np.int64 if room < 2**62 else object), unit


def _memberships(strata: np.ndarray, n1: int) -> tuple[np.ndarray, bool, int]:
    """Return who could have been in the first group, one way a row (0 or 1)."""
    places = [np.flatnonzero(strata == name) for name in dict.fromkeys(strata)]
    sizes = [int((place < n1).sum()) for place in places]
    ways = prod(comb(len(place), size) for place, size in zip(places, sizes, strict=True))
    symmetric = all(2 * size == len(place) for place, size in zip(places, sizes, strict=True))
    if ways > ENUMERATED:
        return _sampled(strata, places, sizes), False, 1
    members = np.zeros((1, len(strata)), dtype=np.int64)
    for place, size in zip(places, sizes, strict=True):
        chosen = np.array(list(combinations(place, size)), dtype=int).reshape(-1, size)
        block = np.zeros((len(chosen), len(strata)), dtype=np.int64)
        np.put_along_axis(block, chosen, 1, axis=1)
        members = (members[:, None] + block[None]).reshape(-1, len(strata))
    return members, True, 2 if symmetric and ways > 1 else 1


def _sampled(strata: np.ndarray, places: list[np.ndarray], sizes: list[int]) -> np.ndarray:
    rng = np.random.default_rng(_SEED)
    members = np.zeros((SAMPLED, len(strata)), dtype=np.int64)
    for place, size in zip(places, sizes, strict=True):
        order = rng.random((SAMPLED, len(place))).argsort(axis=1)[:, :size]
        np.put_along_axis(members, place[order], 1, axis=1)
    return members
