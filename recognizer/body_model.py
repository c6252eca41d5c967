"""The default model: a learnt metric, the nearest neighbours of each class in it, and a limit from unseen persons."""

from __future__ import annotations

import numpy as np

from recognizer.database import IRRELEVANT, Database
from recognizer.decision import SHOWN, Decision, neighbour
from recognizer.metric import DiscriminantMetric
from recognizer.mirror import with_mirrored

NEIGHBOURS = 3
POWER = 2.0  # n of the votes 1/dⁿ that are reported
SHRINKAGE = 0.3
FALSE_REJECTION = 0.03  # share of true gestures of unseen persons that the limit gives up
FOLDS = 6


def metric_classes(database: Database) -> np.ndarray:
    """Classes that the metric separates: gestures, and each kind of irrelevant motion by itself."""
    irrelevant = database.labels == IRRELEVANT
    return np.where(irrelevant, np.char.add("irrelevant:", database.actions), database.labels)


class BodyModel:
    """Neighbours in a discriminant metric.

    Every class is measured by the mean distance of its k nearest rows, so that a class with many clips has no
    more say than one with few. A gesture is rejected when that distance is too large beside the distance of
    irrelevant motion, which also grows where nothing was ever seen.

    Args:
        n_neighbors: k, rows of each class.
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
        self.rows = with_mirrored(database)
        stored = database.arrays
        if "components" in stored:
            self._measure(stored["mean"], stored["scale"], stored["components"].astype(np.float32))
            self.limit_ = float(stored["limit"])
            return self
        self._learn_metric()
        self.limit_ = self._learn_limit(database)
        return self

    def _learn_metric(self) -> None:
        classes = metric_classes(self.rows)
        if len(np.unique(classes)) < 2:  # nothing to tell apart: every feature counts by its own spread
            deviation = self.rows.features.std(axis=0) + 1e-3
            size = len(deviation)
            self._measure(self.rows.features.mean(axis=0), deviation, np.eye(size) / np.sqrt(size))
            return
        metric = DiscriminantMetric(self.shrinkage).fit(self.rows.features, classes)
        self._measure(metric.mean_, metric.scale_, metric.components_)

    def _measure(self, mean: np.ndarray, scale: np.ndarray, components: np.ndarray) -> None:
        self._mean, self._scale, self._components = mean, scale, components
        self._projected = self.project(self.rows.features)
        self._labels, self._targets = np.unique(self.rows.labels, return_inverse=True)

    def project(self, vectors: np.ndarray) -> np.ndarray:
        """Bring feature vectors (n, d) into the metric, (n, c)."""
        return ((vectors - self._mean) / self._scale) @ self._components

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """What was learned, to be stored beside the rows."""
        return {
            "mean": self._mean.astype(np.float32),
            "scale": self._scale.astype(np.float32),
            "components": self._components.astype(np.float16),
            "limit": np.array(self.limit_),
        }

    def _learn_limit(self, database: Database) -> float:
        """Relative distance that all but 3 % of the gestures of unseen persons stay within, by folds over persons."""
        persons = np.unique(database.persons)
        if len(persons) < 2:
            return float("inf")
        found: list[float] = []
        for fold in range(min(FOLDS, len(persons))):
            unseen = np.isin(database.persons, persons[fold::FOLDS])
            model = BodyModel(self.n_neighbors, self.shrinkage)
            model.rows, model.limit_ = with_mirrored(database.take(~unseen)), float("inf")
            model._learn_metric()
            gestures = database.features[unseen & (database.labels != IRRELEVANT)]
            if (model.rows.labels != IRRELEVANT).any():
                found += [model.decide(vector).distance for vector in gestures]
        return float(np.quantile(found, 1 - FALSE_REJECTION)) if found else float("inf")

    def _class_distances(self, distances: np.ndarray, k: int) -> np.ndarray:
        """Mean distance of the k nearest rows of each label, (n_labels,)."""
        out = np.empty(len(self._labels))
        for target in range(len(self._labels)):
            own = distances[self._targets == target]
            near = min(k, len(own))
            out[target] = np.partition(own, near - 1)[:near].mean()
        return out

    def decide(self, vector: np.ndarray, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Name a feature vector.

        Args:
            vector: (d,) features.
            among: labels that the context allows; irrelevant motion always competes.
            k: number of neighbours of each class, the model's own when None.
        """
        distances = np.linalg.norm(self._projected - self.project(vector[None])[0], axis=1)
        by_class = self._class_distances(distances, k or self.n_neighbors)
        allowed = self._labels != IRRELEVANT
        if among is not None:
            allowed &= np.isin(self._labels, list(among))
        winner = int(np.argmin(np.where(allowed, by_class, np.inf)))
        name = str(self._labels[winner])
        irrelevant = by_class[self._labels == IRRELEVANT]
        # Without irrelevant motion in the database the plain distance has to do.
        distance = float(by_class[winner] / max(irrelevant[0], 1e-9)) if len(irrelevant) else float(by_class[winner])
        order = np.argsort(
            np.where(allowed[self._targets] | (self.rows.labels == IRRELEVANT), distances, np.inf), kind="stable"
        )
        reason = self._reason(name, distance, distances) if distance > self.limit_ else ""
        weight = np.where(allowed | (self._labels == IRRELEVANT), 1 / np.maximum(by_class, 1e-9) ** POWER, 0.0)
        votes = {str(n): float(w) for n, w in zip(self._labels, weight / weight.sum(), strict=True) if w > 0}
        return Decision(
            None if reason else name,
            name,
            str(self.rows.families[self._targets == winner][0]),
            bool(reason),
            reason,
            distance,
            self.limit_,
            votes,
            tuple(neighbour(self.rows, int(row), float(distances[row])) for row in order[:SHOWN]),
        )

    def _reason(self, name: str, distance: float, distances: np.ndarray) -> str:
        irrelevant = np.flatnonzero(self.rows.labels == IRRELEVANT)
        if len(irrelevant) == 0:
            return f"nearest is {name} at distance {distance:.3g}, beyond {self.limit_:.3g}"
        action = self.rows.actions[irrelevant[np.argmin(distances[irrelevant])]]
        return f"{name} is {distance:.2f} times as far as irrelevant motion ({action}); the limit is {self.limit_:.2f}"
