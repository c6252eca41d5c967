"""Two raters side by side: the table of their scores, percent and kappa."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from nao_sim.game.agreement.kappa import cohen_kappa
from nao_sim.game.agreement.measure import Measure


@dataclass(frozen=True)
class PairAgreement:
    """How two raters agree on the turns that both scored.

    Attributes:
        first, second: the raters.
        scores: the scale, lowest first.
        table: counts; ``table[i][j]`` turns that the first scored ``scores[i]`` and the second ``scores[j]``.
        agree, both: turns scored alike, of the turns that both scored.
        only_first, only_second: turns that one alone scored.
        kappas: unweighted, and on a scale of more than two scores also with linear and quadratic weights.
        differ: the keys of the turns that were scored differently.
    """

    first: str
    second: str
    scores: tuple[int, ...]
    table: tuple[tuple[int, ...], ...]
    agree: int
    both: int
    only_first: int
    only_second: int
    kappas: tuple[Measure, ...]
    differ: tuple[str, ...]

    @property
    def percent(self) -> str:
        """Percent agreement in words, its counts first."""
        return f"{self.agree} of {self.both} ({100 * self.agree / self.both:.0f} %)" if self.both else "none in common"


def pair_agreement(
    first: tuple[str, Mapping[str, int]], second: tuple[str, Mapping[str, int]], scores: tuple[int, ...]
) -> PairAgreement:
    """Compare two raters.

    Args:
        first: the first rater's name, and their score of each turn by its key.
        second: the second rater's.
        scores: the scale, lowest first.
    """
    a, b = first[1], second[1]
    common = [key for key in a if key in b]
    table = np.zeros((len(scores), len(scores)), dtype=int)
    for key in common:
        table[scores.index(a[key]), scores.index(b[key])] += 1
    kappas = [cohen_kappa(table)]
    if len(scores) > 2:
        kappas += [cohen_kappa(table, "linear"), cohen_kappa(table, "quadratic")]
    return PairAgreement(
        first=first[0],
        second=second[0],
        scores=scores,
        table=tuple(tuple(int(n) for n in row) for row in table),
        agree=int(np.trace(table)),
        both=len(common),
        only_first=len(a.keys() - b.keys()),
        only_second=len(b.keys() - a.keys()),
        kappas=tuple(kappas),
        differ=tuple(key for key in common if a[key] != b[key]),
    )
