"""Which of a clip's candidates is the person? A quadratic score of what is known of each.

Whether a place that looks like a head is one depends on its size, on what moves there, and on both together: linear
weights choose wrongly a third more often.
"""

from __future__ import annotations

import dataclasses
import functools
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures, StandardScaler

STRENGTH = 0.03  # inverse of the pull towards equal scores
FARTHEST = 4.0  # deviations from the mean: what is further off than training ever was counts as this far
FILE = "ranking.npz"


@dataclasses.dataclass(frozen=True)
class Ranking:
    """Weights of each column and of each pair of columns.

    Attributes:
        mean, scale: (d,) of the columns.
        linear: (d,) weights of the columns, scaled.
        pairs: (d, d) of the products of two.
        offset: above 0 is more likely the person than not.
    """

    mean: np.ndarray
    scale: np.ndarray
    linear: np.ndarray
    pairs: np.ndarray
    offset: np.ndarray

    @classmethod
    def load(cls) -> Ranking:
        """Read the shipped weights."""
        return _shipped()

    @classmethod
    def fit(cls, table: np.ndarray, right: np.ndarray) -> Ranking:
        """Learn from what is known of candidates (n, d), and whether each is the person (n,)."""
        mean, scale = table.mean(axis=0), table.std(axis=0) + 1e-6
        model = make_pipeline(
            PolynomialFeatures(2, include_bias=False),
            StandardScaler(),
            LogisticRegression(C=STRENGTH, max_iter=2000),
        )
        products, scaler, logistic = (step for _, step in model.fit(_columns(table, mean, scale), right).steps)
        weights = logistic.coef_[0] / scaler.scale_
        size = table.shape[1]
        pairs = np.zeros((size, size))
        for weight, powers in zip(weights[size:], products.powers_[size:], strict=True):
            first, last = np.flatnonzero(powers)[[0, -1]]
            pairs[first, last] = weight
        offset = logistic.intercept_[0] - scaler.mean_ @ weights
        return cls(mean, scale, weights[:size], pairs, np.array(offset))

    def save(self, path: Path) -> None:
        """Write the weights, a few kB."""
        np.savez_compressed(path, **self.arrays)

    @property
    def arrays(self) -> dict[str, Any]:
        """All weights by name, in single precision."""
        return {name: value.astype(np.float32) for name, value in dataclasses.asdict(self).items()}

    def __call__(self, table: np.ndarray) -> np.ndarray:
        """Scores (n,) of candidates (n, d)."""
        columns = _columns(table, self.mean, self.scale)
        scores: np.ndarray = ((columns @ self.pairs + self.linear) * columns).sum(axis=1) + self.offset
        return scores


def _columns(table: np.ndarray, mean: np.ndarray, scale: np.ndarray) -> np.ndarray:
    columns: np.ndarray = ((table - mean) / scale).clip(-FARTHEST, FARTHEST)
    return columns


@functools.lru_cache
def _shipped() -> Ranking:
    with files("recognizer").joinpath(FILE).open("rb") as file, np.load(file) as stored:
        return Ranking(**{name: stored[name] for name in stored.files})
