"""The default model: a learnt metric, then the nearest neighbours in it, and a limit set from unseen persons."""

from __future__ import annotations

import numpy as np

from recognizer.database import IRRELEVANT, Database
from recognizer.decision import Decision, decide
from recognizer.metric import DiscriminantMetric

NEIGHBOURS = 5
POWER = 2.0
SHRINKAGE = 0.3
FALSE_REJECTION = 0.03
FOLDS = 6


def metric_classes(database: Database) -> np.ndarray:
    """Classes that the metric separates: gestures, and each kind of irrelevant motion by itself."""
    irrelevant = database.labels == IRRELEVANT
    return np.where(irrelevant, np.char.add("irrelevant:", database.actions), database.labels)


class BodyModel:
    """Neighbours in a discriminant metric.

    Args:
        n_neighbors: how many vote.
        shrinkage: of the metric's covariance.
    """

    def __init__(self, n_neighbors: int = NEIGHBOURS, shrinkage: float = SHRINKAGE) -> None:
        self.n_neighbors = n_neighbors
        self.shrinkage = shrinkage

    @staticmethod
    def trainable(database: Database) -> Database:
        """Every row is learned from, irrelevant motion too."""
        return database

    def fit(self, database: Database) -> BodyModel:
        """Learn metric and limit, or take them from the database where they are stored."""
        self.database = database
        stored = database.arrays
        if "components" in stored:
            self._set(stored["mean"], stored["scale"], stored["components"])
            self.limit_ = float(stored["limit"])
            return self
        metric = DiscriminantMetric(self.shrinkage).fit(database.features, metric_classes(database))
        self._set(metric.mean_, metric.scale_, metric.components_)
        self.limit_ = self._learn_limit()
        return self

    def _set(self, mean: np.ndarray, scale: np.ndarray, components: np.ndarray) -> None:
        self._mean, self._scale, self._components = mean, scale, components
        self.projected_ = self.project(self.database.features)

    def project(self, vectors: np.ndarray) -> np.ndarray:
        """Bring feature vectors (n, d) into the metric, (n, c)."""
        return ((vectors - self._mean) / self._scale) @ self._components

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """What was learned, to be stored beside the rows."""
        return {
            "mean": self._mean.astype(np.float32),
            "scale": self._scale.astype(np.float32),
            "components": self._components.astype(np.float32),
            "limit": np.array(self.limit_),
        }

    def _learn_limit(self) -> float:
        """Distance that all but 3 % of the gestures of unseen persons stay within, by folds over persons."""
        persons = np.unique(self.database.persons)
        if len(persons) < 2:
            return float("inf")
        found: list[float] = []
        for fold in range(min(FOLDS, len(persons))):
            unseen = np.isin(self.database.persons, persons[fold::FOLDS])
            known = self.database.take(~unseen)
            if len(set(metric_classes(known))) < 2:
                continue
            model = BodyModel(self.n_neighbors, self.shrinkage)
            model.database = known
            metric = DiscriminantMetric(self.shrinkage).fit(known.features, metric_classes(known))
            model._set(metric.mean_, metric.scale_, metric.components_)
            model.limit_ = float("inf")
            for row in np.flatnonzero(unseen & (self.database.labels != IRRELEVANT)):
                decision = model.decide(self.database.features[row])
                if decision.nearest == self.database.labels[row]:
                    found.append(decision.distance)
        return float(np.quantile(found, 1 - FALSE_REJECTION)) if found else float("inf")

    def route(self, vector: np.ndarray) -> str:
        """Return "small" or "large": the family of the nearest gesture."""
        distances = np.linalg.norm(self.projected_ - self.project(vector[None]), axis=1)
        distances[self.database.labels == IRRELEVANT] = np.inf
        return str(self.database.families[int(np.argmin(distances))])

    def decide(self, vector: np.ndarray, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Name a feature vector.

        Args:
            vector: (d,) features.
            among: labels that the context allows; irrelevant motion always competes.
            k: number of neighbours that vote, the model's own when None.
        """
        rows = np.arange(len(self.database))
        if among is not None:
            rows = np.flatnonzero(np.isin(self.database.labels, [*among, IRRELEVANT]))
        distances = np.linalg.norm(self.projected_[rows] - self.project(vector[None])[0], axis=1)
        order = np.argsort(distances, kind="stable")
        k = min(k or self.n_neighbors, len(order))
        return decide(self.database, rows[order], distances[order], k, self.limit_, "distance", POWER)
