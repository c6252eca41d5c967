"""K nearest neighbours as the thesis has it (app. 5, eq. 1-3; S18), as a scikit-learn classifier."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from sklearn.base import BaseEstimator, ClassifierMixin
from sklearn.utils.multiclass import check_classification_targets
from sklearn.utils.validation import check_is_fitted, validate_data

_TINY = 1e-12  # distance of two equal samples, so that 1/dⁿ stays finite


def mixed_distances(
    queries: np.ndarray, samples: np.ndarray, weights: np.ndarray | None = None, discrete: np.ndarray | None = None
) -> np.ndarray:
    """Eq. 1 and 2: weighted sum over features of |q − x|, or of [q ≠ x] where a feature is discrete.

    Args:
        queries: (m, d).
        samples: (n, d).
        weights: (d,) weight of each feature; all 1 when None.
        discrete: (d,) bool; none when None.

    Returns:
        (m, n) distances.
    """
    weights = np.ones(samples.shape[1]) if weights is None else np.asarray(weights, float)
    discrete = np.zeros(samples.shape[1], bool) if discrete is None else np.asarray(discrete, bool)
    out = np.empty((len(queries), len(samples)))
    for i, query in enumerate(queries):
        delta = np.abs(samples - query)
        delta[:, discrete] = delta[:, discrete] != 0
        out[i] = delta @ weights
    return out


class NeighbourClassifier(ClassifierMixin, BaseEstimator):
    """KNN over features in [0, 1] with the mixed metric and majority or 1/dⁿ votes.

    Parameters
    ----------
    n_neighbors : int, default=1
        k.
    vote : {"majority", "distance"}, default="majority"
        Each neighbour counts 1, or 1/dⁿ (eq. 3).
    power : float, default=1.0
        n of eq. 3.
    discrete : sequence of int or None, default=None
        Columns that are discrete; all others are continuous.
    weights : sequence of float or None, default=None
        w of eq. 1 for each feature.
    normalize : bool, default=True
        Bring each continuous feature to [0, 1] by its range in the training set.

    Attributes
    ----------
    classes_ : ndarray
        Labels, sorted.
    samples_ : ndarray of shape (n_samples, n_features)
        The database, normalised.
    targets_ : ndarray of shape (n_samples,)
        Index into ``classes_`` of each sample.
    """

    def __init__(
        self,
        n_neighbors: int = 1,
        vote: str = "majority",
        power: float = 1.0,
        discrete: Sequence[int] | None = None,
        weights: Sequence[float] | None = None,
        normalize: bool = True,
    ) -> None:
        self.n_neighbors = n_neighbors
        self.vote = vote
        self.power = power
        self.discrete = discrete
        self.weights = weights
        self.normalize = normalize

    def fit(self, X: Any, y: Any) -> NeighbourClassifier:
        """Store the database: X of shape (n_samples, n_features), y of shape (n_samples,)."""
        X, y = validate_data(self, X, y, dtype=float)
        check_classification_targets(y)
        if self.vote not in ("majority", "distance"):
            raise ValueError(f"vote='{self.vote}': choose 'majority' or 'distance'")
        if self.n_neighbors < 1:
            raise ValueError(f"n_neighbors={self.n_neighbors}: one neighbour at least")
        self.classes_, self.targets_ = np.unique(y, return_inverse=True)
        self.discrete_ = np.zeros(X.shape[1], bool)
        if self.discrete is not None:
            self.discrete_[list(self.discrete)] = True
        self.low_, span = X.min(axis=0), np.ptp(X, axis=0)
        self.span_ = np.where(span > 0, span, 1.0)
        self.samples_ = self._normal(X)
        return self

    def _normal(self, X: np.ndarray) -> np.ndarray:
        if not self.normalize:
            return X
        return np.where(self.discrete_, X, (X - self.low_) / self.span_)

    def kneighbors(self, X: Any, n_neighbors: int | None = None) -> tuple[np.ndarray, np.ndarray]:
        """Return distances and sample indices of the k nearest, each (n_queries, k), nearest first.

        A database with fewer than k samples gives all it has.
        """
        check_is_fitted(self)
        X = validate_data(self, X, dtype=float, reset=False)
        k = min(n_neighbors or self.n_neighbors, len(self.samples_))
        weights = None if self.weights is None else np.asarray(self.weights, float)
        distances = mixed_distances(self._normal(X), self.samples_, weights, self.discrete_)
        order = np.argsort(distances, axis=1, kind="stable")[:, :k]
        return np.take_along_axis(distances, order, axis=1), order

    def predict_proba(self, X: Any) -> np.ndarray:
        """Return each class's share of the votes, (n_queries, n_classes)."""
        distances, order = self.kneighbors(X)
        votes = votes_of(distances, self.targets_[order], len(self.classes_), self.vote, self.power)
        return votes / votes.sum(axis=1, keepdims=True)

    def predict(self, X: Any) -> np.ndarray:
        """Return the class with most votes of each query; a tie goes to the first in sorted order."""
        shares = self.predict_proba(X)
        return self.classes_[np.argmax(shares, axis=1)]


def votes_of(distances: np.ndarray, targets: np.ndarray, n_classes: int, vote: str, power: float) -> np.ndarray:
    """Eq. 3 for each query: votes of the neighbours at ``distances`` (m, k) for classes ``targets`` (m, k)."""
    weight = np.ones_like(distances) if vote == "majority" else 1.0 / np.maximum(distances, _TINY) ** power
    votes = np.zeros((len(distances), n_classes))
    np.add.at(votes, (np.arange(len(distances))[:, None], targets), weight)
    return votes
