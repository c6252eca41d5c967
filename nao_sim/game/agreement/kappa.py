"""Cohen's kappa for two raters, plain or weighted (Cohen 1960, 1968)."""

from __future__ import annotations

from typing import Literal

import numpy as np

from nao_sim.game.agreement.measure import Measure

Weights = Literal["none", "linear", "quadratic"]


def cohen_kappa(table: np.ndarray, weights: Weights = "none") -> Measure:
    """Return kappa of a table of counts.

    ``kappa = 1 - sum(w * observed) / sum(w * expected)`` with w = 1 off the diagonal, or the distance of the two
    categories, or its square.

    Args:
        table: counts, shape (categories, categories), first rater in rows; the categories stand in their order, those
            of a scale that nobody used included (the distances count them).
        weights: how much a disagreement weighs.

    Returns:
        The coefficient; not defined where both raters used one and the same category throughout.
    """
    name = "Cohen's kappa, " + ("unweighted" if weights == "none" else f"{weights} weights")
    counts = np.asarray(table, dtype=float)
    total = counts.sum()
    categories = np.arange(len(counts))
    distance = np.abs(categories[:, None] - categories)
    w = {"none": distance > 0, "linear": distance, "quadratic": distance**2}[weights].astype(float)
    expected = np.outer(counts.sum(axis=1), counts.sum(axis=0))
    chance = (w * expected).sum()
    if total == 0 or chance == 0:
        return Measure.undefined(name, int(np.trace(counts)), int(total))
    return Measure.of(name, float(1 - (w * counts).sum() * total / chance))
