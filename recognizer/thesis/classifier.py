"""The thesis's classifier: nearest neighbours of each family, with the rules of size that part yes from no.

Small or large is told by the amplitude (chapter 3), *yes* and *no* from the other small gestures and from each other by
the size of their motion (ch. 2 (1-5), S11), the rest by the nearest vector (S12, S13).
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from recognizer.learning.database import IRRELEVANT, Database
from recognizer.learning.decision import Decision, decide
from recognizer.learning.neighbour_classifier import NeighbourClassifier
from recognizer.thesis.vectors import LARGE, SMALL

COAXIAL = ("yes", "no")


def size_threshold(low: np.ndarray, high: np.ndarray) -> float:
    """Return the size between two samples of sizes that tells most of them apart (low ones below it)."""
    values = np.unique(np.concatenate([low, high]))
    if len(values) < 2:
        return float(values[0]) if len(values) else 0.0
    cuts = (values[:-1] + values[1:]) / 2
    # Balanced: both samples count the same, however many clips each has.
    right = [np.mean(low < cut) if len(low) else 0 for cut in cuts]
    wrong = [np.mean(high < cut) if len(high) else 0 for cut in cuts]
    return float(cuts[int(np.argmax(np.array(right) - np.array(wrong)))])


class ThesisModel:
    """KNN of each family over a database of thesis vectors, with the two size rules and a distance limit."""

    def __init__(self, n_neighbors: int = 1, rule: str = "whole_path") -> None:
        self.n_neighbors = n_neighbors
        self.rule = rule

    def fit(self, database: Database) -> ThesisModel:
        """Learn routing threshold, size thresholds, and the distance that 97 % of known gestures stay within."""
        self.database = database
        transitions = database.features[:, 0 if self.rule == "first_to_last" else 1]
        self.route_ = size_threshold(
            transitions[database.families == "small"], transitions[database.families == "large"]
        )
        size = database.features[:, 2]
        coaxial = np.isin(database.labels, COAXIAL)
        self.coaxial_ = size_threshold(size[coaxial], size[(database.families == "small") & ~coaxial])
        yes, no = size[database.labels == "yes"], size[database.labels == "no"]
        self.yes_below_no_ = bool(len(yes) == 0 or len(no) == 0 or np.median(yes) <= np.median(no))
        self.yes_no_ = size_threshold(yes, no) if self.yes_below_no_ else size_threshold(no, yes)
        self.limits_ = {family: self._limit(family) for family in ("small", "large")}
        return self

    def _rows(self, family: str, among: set[str] | None = None) -> np.ndarray:
        keep = self.database.families == family
        if among is not None:
            keep &= np.isin(self.database.labels, list(among))
        return np.flatnonzero(keep)

    def _limit(self, family: str, false_rejection: float = 0.03) -> float:
        rows = self._rows(family)
        persons = self.database.persons[rows]
        if len(np.unique(persons)) < 2:
            return float("inf")
        X = self.database.features[rows][:, SMALL if family == "small" else LARGE]
        knn = NeighbourClassifier(1).fit(X, self.database.labels[rows])
        distances, order = knn.kneighbors(X, len(X))
        other = persons[order] != persons[:, None]
        same = self.database.labels[rows][order] == self.database.labels[rows][:, None]
        nearest = np.where(other & same, distances, np.inf).min(axis=1)
        return (
            float(np.quantile(nearest[np.isfinite(nearest)], 1 - false_rejection))
            if np.isfinite(nearest).any()
            else float("inf")
        )

    def route(self, vector: np.ndarray) -> str:
        """Return "small" or "large" for a vector by its centroid transition."""
        return "large" if vector[0 if self.rule == "first_to_last" else 1] > self.route_ else "small"

    def decide(self, vector: np.ndarray, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Route a vector and name it; ``among`` narrows the labels, ``k`` overrides the number of votes."""
        family = self.route(vector)
        rows = self._rows(family, among)
        if len(rows) == 0:  # nothing of that family is allowed in this context
            family = "large" if family == "small" else "small"
            rows = self._rows(family, among)
        if family == "small":
            rows = self._coaxial_rows(rows, float(vector[2]))
        columns = SMALL if family == "small" else LARGE
        k = k or self.n_neighbors
        knn = NeighbourClassifier(k).fit(self.database.features[rows][:, columns], self.database.labels[rows])
        distances, order = knn.kneighbors(vector[None, columns], max(5, k))
        return decide(self.database, rows[order[0]], distances[0], k, self.limits_[family])

    def _coaxial_rows(self, rows: np.ndarray, size: float) -> np.ndarray:
        """The size rules of ch. 2 (1-5): little motion is yes or no, again by its size; the rest is neither."""
        labels = self.database.labels[rows]
        if size < self.coaxial_:
            keep = labels == ("yes" if (size < self.yes_no_) == self.yes_below_no_ else "no")
        else:
            keep = ~np.isin(labels, COAXIAL)
        return rows[keep] if keep.any() else rows

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """Nothing is stored beside the rows: everything is found anew from them."""
        return {}

    @staticmethod
    def trainable(database: Database) -> Database:
        """The thesis has no class of irrelevant motion; rows of it are left out."""
        return database.take(database.labels != IRRELEVANT)

    @classmethod
    def learner(cls, database: Database) -> Callable[[np.ndarray], ThesisModel]:
        """Return what learns models from some rows (a mask or indices) of a database."""
        return lambda rows: cls().fit(cls.trainable(database.take(rows)))
