"""Which posture: neighbours in a learnt space of few dimensions, and a distance beyond which there is no answer.

The space is that of a shrinkage LDA after a PCA, learnt from the database; in it, takes of one posture by different
persons lie close together, and plain nearest neighbours (S7, S18) decide.
"""

from __future__ import annotations

import dataclasses
from typing import Any

import numpy as np
from sklearn.base import BaseEstimator, ClassifierMixin, clone
from sklearn.decomposition import PCA
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis
from sklearn.model_selection import GroupKFold
from sklearn.utils.multiclass import check_classification_targets
from sklearn.utils.validation import check_is_fitted, validate_data

from recognizer.learning.database import IRRELEVANT, Database
from recognizer.learning.decision import Decision, decide
from recognizer.learning.neighbour_classifier import NeighbourClassifier
from recognizer.postures.types import Floats

FALSE_REJECTION = 0.02  # of the database's own postures, person-disjoint; 98 of 100 shall be named
IRRELEVANT_COST = 1.15  # an irrelevant hand must be nearer than a posture by this factor to win


class PostureClassifier(ClassifierMixin, BaseEstimator):
    """PCA, shrinkage LDA, then k nearest neighbours under the city-block metric of appendix 5.

    Parameters
    ----------
    n_neighbors : int, default=5
        k.
    n_components : int, default=200
        Dimensions kept by the PCA, at most.
    shrinkage : float, default=0.05
        Of the covariance within classes, 0 to 1.

    Attributes
    ----------
    classes_ : ndarray
        Labels, sorted.
    mean_ : ndarray of shape (n_features,)
        What is subtracted before the projection.
    projection_ : ndarray of shape (n_features, n_dimensions)
        PCA and LDA in one matrix.
    neighbours_ : NeighbourClassifier
        The projected samples.
    """

    def __init__(self, n_neighbors: int = 5, n_components: int = 200, shrinkage: float = 0.05) -> None:
        self.n_neighbors = n_neighbors
        self.n_components = n_components
        self.shrinkage = shrinkage

    def fit(self, X: Any, y: Any) -> PostureClassifier:
        """Learn the space and keep the samples: X of shape (n_samples, n_features), y of shape (n_samples,)."""
        X, y = validate_data(self, X, y, dtype=float, ensure_min_samples=2)
        check_classification_targets(y)
        self.classes_ = np.unique(y)
        self.mean_, self.projection_ = self._learn(X, y)
        self.neighbours_ = NeighbourClassifier(self.n_neighbors, normalize=False).fit(self._project(X), y)
        return self

    def _learn(self, X: Floats, y: np.ndarray) -> tuple[Floats, Floats]:
        pca = PCA(min(self.n_components, *X.shape), svd_solver="full" if len(X) < X.shape[1] else "covariance_eigh")
        reduced = pca.fit_transform(X)
        if len(self.classes_) < 2 or len(self.classes_) == len(X):  # nothing to tell apart, or no spread to learn
            return pca.mean_, pca.components_.T
        lda = LinearDiscriminantAnalysis(solver="eigen", shrinkage=self.shrinkage).fit(reduced, y)
        return pca.mean_, pca.components_.T @ lda.scalings_[:, : len(self.classes_) - 1]

    def _project(self, X: Floats) -> Floats:
        return (X - self.mean_) @ self.projection_

    def kneighbors(self, X: Any, n_neighbors: int | None = None) -> tuple[Floats, np.ndarray]:
        """Return distances and sample indices of the k nearest, each (n_queries, k), nearest first."""
        check_is_fitted(self)
        X = validate_data(self, X, dtype=float, reset=False)
        return self.neighbours_.kneighbors(self._project(X), n_neighbors)

    def predict_proba(self, X: Any) -> Floats:
        """Return each class's share of the votes, (n_queries, n_classes)."""
        check_is_fitted(self)
        X = validate_data(self, X, dtype=float, reset=False)
        return self.neighbours_.predict_proba(self._project(X))

    def predict(self, X: Any) -> np.ndarray:
        """Return the class with most votes of each query."""
        winners = np.argmax(self.predict_proba(X), axis=1)
        return self.classes_[winners]


class PostureModel:
    """A database of postures that answers.

    Every irrelevant action is a class of its own while the space is learnt, and one class when it votes.

    Args:
        classifier: what it decides with; `PostureClassifier` with its defaults when None.
    """

    def __init__(self, classifier: Any = None) -> None:
        self.classifier = PostureClassifier() if classifier is None else classifier

    def fit(self, database: Database) -> PostureModel:
        """Learn the space and the threshold from a database."""
        self.database = database
        kinds = _kinds(database)
        self.classifier.fit(database.features, kinds)
        stored = database.arrays.get("threshold")
        self.threshold_ = float(stored) if stored is not None else self._threshold(kinds)
        return self

    def _threshold(self, kinds: np.ndarray) -> float:
        """Return the distance to their own kind that 98 % of known postures by unknown persons stay within."""
        database, persons = self.database, self.database.persons
        folds = min(5, len(np.unique(persons)))
        if folds < 2:
            return float("inf")
        distances = np.full(len(database), np.inf)
        for train, test in GroupKFold(folds).split(database.features, kinds, persons):
            model = clone(self.classifier).fit(database.features[train], kinds[train])
            far, rows = model.kneighbors(database.features[test], len(train))
            same = kinds[train][rows] == kinds[test][:, None]
            distances[test] = np.where(same, far, np.inf).min(axis=1)
        known = distances[(database.labels != IRRELEVANT) & np.isfinite(distances)]
        return float(np.quantile(known, 1 - FALSE_REJECTION)) if len(known) else float("inf")

    def trained(self) -> Database:
        """Return the database with the threshold kept in it."""
        return dataclasses.replace(self.database, arrays={"threshold": np.array(self.threshold_)})

    def decide(self, vector: Floats, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Name one posture vector; ``among`` narrows the labels (irrelevant hands stay possible), ``k`` the votes."""
        distances, rows = self.classifier.kneighbors(vector[None], len(self.database))
        far, order = distances[0], rows[0]
        far = np.where(self.database.labels[order] == IRRELEVANT, far * IRRELEVANT_COST, far)
        if among is not None:
            keep = np.isin(self.database.labels[order], [*among, IRRELEVANT])
            far, order = far[keep], order[keep]
        again = np.argsort(far, kind="stable")
        far, order = far[again], order[again]
        k = k or self.classifier.n_neighbors
        found = decide(self.database, order[: 4 * k], far[: 4 * k], k, self.threshold_)
        if found.nearest != IRRELEVANT:
            return found
        action = next(n.action for n in found.neighbours if n.label == IRRELEVANT)
        reason = f"nearest is a hand that shows none of the postures ({action}) at {found.distance:.3g}"
        return dataclasses.replace(found, label=None, rejected=True, reason=reason)


def _kinds(database: Database) -> np.ndarray:
    """Return the class of each row while the space is learnt: its label, or what was done if irrelevant."""
    return np.where(database.labels == IRRELEVANT, np.char.add("irrelevant ", database.actions), database.labels)
