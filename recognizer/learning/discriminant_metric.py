"""A learnt metric in front of the neighbours: linear discriminants of a regularised covariance."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from sklearn.base import BaseEstimator, ClassNamePrefixFeaturesOutMixin, TransformerMixin
from sklearn.utils.multiclass import check_classification_targets
from sklearn.utils.validation import check_is_fitted, validate_data

from recognizer.learning.scatter_matrices import Scatter


class DiscriminantMetric(ClassNamePrefixFeaturesOutMixin, TransformerMixin, BaseEstimator):
    """Project onto the directions that separate the classes, scaled so that persons of one class differ by 1.

    Fisher's discriminant with the within-class covariance shrunk towards a multiple of the identity
    (Friedman, JASA 84, 1989). One product of the rows with themselves and one Cholesky factor: a thousand clips of a
    thousand features take a second.

    Parameters
    ----------
    shrinkage : float, default=0.3
        Share of the identity in the covariance, 0 … 1.

    Attributes
    ----------
    mean_, scale_ : ndarray of shape (n_features,)
        What features are centred and divided by.
    components_ : ndarray of shape (n_features, n_components)
        Directions; at most one fewer than classes.
    """

    def __init__(self, shrinkage: float = 0.3) -> None:
        self.shrinkage = shrinkage

    def fit(self, X: Any, y: Any) -> DiscriminantMetric:
        """Learn the directions from X (n_samples, n_features) and labels y (n_samples,)."""
        X, y = validate_data(self, X, y, dtype=[np.float64, np.float32])
        check_classification_targets(y)
        if not 0 < self.shrinkage <= 1:
            raise ValueError(f"shrinkage={self.shrinkage}: choose above 0, up to 1")
        classes, index = np.unique(y, return_inverse=True)
        if len(classes) < 2:
            raise ValueError("the metric needs two classes at least; got 1 class")
        return self.fit_scatter(Scatter.of_rows(X, index, len(classes)))

    def fit_scatter(self, scatter: Scatter) -> DiscriminantMetric:
        """Learn the directions from what is known of the rows of two classes at least."""
        self.n_features_in_ = len(scatter.unit)
        self.mean_, deviation = scatter.mean(), scatter.deviation()
        # A feature that hardly varies must not be blown up: small next to the typical one.
        self.scale_ = deviation + 0.02 * deviation.mean() + 1e-9
        covariance = scatter.within(self.scale_)
        ridge = max(float(np.trace(covariance)) / len(covariance), 1e-9)
        # Less of the identity than single precision rounds away could not be factored.
        shrinkage = max(self.shrinkage, len(covariance) * float(np.finfo(np.float32).eps))
        covariance *= 1 - shrinkage
        covariance[np.diag_indices_from(covariance)] += shrinkage * ridge
        means = (scatter.class_means() - self.mean_) / self.scale_
        centred = means - means.mean(axis=0)
        # Single precision halves the time of what is slow; the shrinkage hides what it rounds.
        factor = cho_factor(covariance, overwrite_a=True, check_finite=False)
        directions = cho_solve(factor, centred.T.astype(np.float32), check_finite=False).astype(float)
        values, vectors = np.linalg.eigh(centred @ directions)
        keep = values > values.max() * 1e-6
        self.components_ = directions @ vectors[:, keep] / np.sqrt(values[keep])
        self._n_features_out = self.components_.shape[1]
        return self

    def transform(self, X: Any) -> np.ndarray:
        """Project X (n_samples, n_features) to (n_samples, n_components)."""
        check_is_fitted(self)
        X = validate_data(self, X, dtype=[np.float64, np.float32], reset=False)
        return ((X - self.mean_) / self.scale_) @ self.components_
