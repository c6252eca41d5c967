"""How much each class's neighbours count: weights of the distances, learnt on persons the neighbours do not know.

A class whose performances vary (*stop*) lies near everything, one that is always done alike (*kowtow*) near nothing.
Weighing the logarithms of the distances makes up for it; the weights of one distance a class are those of votes 1/dⁿ
with an n of its own for each pair of classes.
"""

from __future__ import annotations

import dataclasses

import numpy as np
from sklearn.linear_model import LogisticRegression

STRENGTH = 10.0  # inverse of the pull towards equal weights
FARTHEST = 20.0  # logarithm that stands for a class without rows


@dataclasses.dataclass(frozen=True)
class Weights:
    """Multinomial logistic weights.

    Attributes:
        coefficients: (n_labels, n_distances).
        offsets: (n_labels,).
    """

    coefficients: np.ndarray
    offsets: np.ndarray

    @classmethod
    def plain(cls, n_labels: int, power: float) -> Weights:
        """Votes 1/dⁿ from the first distance of each label."""
        coefficients = np.zeros((n_labels, 2 * n_labels))
        coefficients[:, :n_labels] = power * np.eye(n_labels)
        return cls(coefficients, np.zeros(n_labels))

    @classmethod
    def fit(cls, distances: np.ndarray, targets: np.ndarray) -> Weights:
        """Learn from distances (n, 2·n_labels) of clips whose labels are ``targets`` (n,), all labels among them."""
        model = LogisticRegression(C=STRENGTH, max_iter=5000, tol=1e-3).fit(nearness(distances), targets)
        coefficients, offsets = model.coef_, model.intercept_
        if len(coefficients) == 1:  # two labels share one row
            coefficients, offsets = np.vstack([-coefficients, coefficients]) / 2, np.append(-offsets, offsets) / 2
        return cls(coefficients, offsets)

    def shares(self, distances: np.ndarray, allowed: np.ndarray) -> np.ndarray:
        """Return each label's share (n_labels,) of the votes, 0 where not ``allowed``."""
        logits = self.coefficients @ nearness(distances[None])[0] + self.offsets
        votes = np.where(allowed, np.exp(logits - logits[allowed].max()), 0.0)
        return votes / votes.sum()


def nearness(distances: np.ndarray) -> np.ndarray:
    """Minus the logarithm of distances (n, d), from their mean: twice as far from all is the same."""
    logs = -np.log(np.clip(distances, 1e-6, np.exp(FARTHEST)))
    out: np.ndarray = logs - logs.mean(axis=1, keepdims=True)
    return out
