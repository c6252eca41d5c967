"""The default model: a learnt metric, each class's nearest neighbours in it, weighed; limits from unseen persons."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from recognizer.learning.database import IRRELEVANT, Database
from recognizer.learning.decision import SHOWN, Decision, neighbour
from recognizer.learning.distance_weights import Weights
from recognizer.learning.mirror import twins
from recognizer.learning.neighbour_distances import MeasuredRows, Metric
from recognizer.learning.person_folds import KnownRows

NEIGHBOURS = 5
POWER = 2.0  # n of the votes 1/dⁿ where no weights could be learnt
SHRINKAGE = 0.3
FALSE_REJECTION = 0.03  # share of true gestures of unseen persons that the limit gives up
NEVER_SEEN = 0.002  # share of them that is further from its gesture than anything answered
MANY = 5000  # rows: from here on a network can be learnt beside the linear weights …
LIMIT_FOLDS = 3  # … and so many folds of persons, whom the weights do not know, say what the limits are


class BodyModel:
    """Weighed neighbours in a discriminant metric.

    Every class, and every kind of irrelevant motion, is measured by the mean distance of its nearest rows, so that one
    with many clips has no more say than one with few. Weights of these distances, and with many rows a small network
    beside them (:mod:`recognizer.learning.distance_weights`), are learnt on persons whose rows were left out, and give
    each class its share. A gesture is rejected when irrelevant motion is too likely beside it, and when it is further
    from its own rows than gestures of unseen persons are.

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

    @classmethod
    def learner(cls, database: Database) -> Callable[[np.ndarray], BodyModel]:
        """Return what learns models from some rows (a mask or indices) of a database; each costs little."""
        known = KnownRows(database)

        def learn(rows: np.ndarray) -> BodyModel:
            used = np.zeros(len(database), bool)
            used[rows] = True
            return cls()._learn(known, used)

        return learn

    def fit(self, database: Database) -> BodyModel:
        """Learn metric, weights and limits, or take them from the database where they are stored."""
        stored = database.arrays
        if not {"components", "linear"} <= stored.keys():  # nothing yet, or by a former version
            return self._learn(KnownRows(database), np.ones(len(database), bool))
        rows = database.rows.with_others(twins(database)) if database.mirror else database.rows
        metric = Metric(stored["mean"], stored["scale"], stored["components"].astype(np.float32))
        self._know(MeasuredRows(metric, rows, database.features, bool(database.mirror)))
        self.weights_ = Weights.of_arrays(stored)
        self.limit_, self.farthest_ = float(stored["limit"]), float(stored["farthest"])
        return self

    def _learn(self, known: KnownRows, used: np.ndarray) -> BodyModel:
        self._know(self._measured(known, used))
        self._learn_weights(known, used)
        return self

    def _measured(self, known: KnownRows, used: np.ndarray) -> MeasuredRows:
        metric = Metric(*known.metric(used, self.shrinkage))
        return MeasuredRows(metric, known.rows(used), known.database.features[used], bool(known.database.mirror))

    def _know(self, measured: MeasuredRows) -> None:
        self.measured_ = measured
        self._is_gesture = measured.labels != IRRELEVANT

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """What was learned, to be stored beside the rows."""
        metric = self.measured_.metric
        return {
            "mean": metric.mean.astype(np.float32),
            "scale": metric.scale.astype(np.float32),
            "components": metric.components.astype(np.float16),
            **self.weights_.arrays,
            "limit": np.array(self.limit_),
            "farthest": np.array(self.farthest_),
        }

    def _learn_weights(self, known: KnownRows, used: np.ndarray) -> None:
        """Weights and limits from persons whose rows are left out, by folds over persons."""
        labels = self.measured_.labels
        self.weights_ = Weights.plain(len(labels), len(self.measured_.kinds), POWER)
        self.limit_, self.farthest_ = np.inf, np.inf
        groups = np.unique(known.groups[used])
        if len(groups) < 2 or len(labels) < 2:
            return
        distances, targets, folds = [], [], []
        for number, group in enumerate(groups):
            unseen = used & (known.groups == group)
            others = self._measured(known, used & ~unseen)
            features = known.database.features[unseen]
            distances.append(others.distances_as(self.measured_, features, self.n_neighbors))
            targets.append(np.searchsorted(labels, known.database.labels[unseen]))
            folds.append(np.full(len(features), number % LIMIT_FOLDS))
        found, true, fold = np.concatenate(distances), np.concatenate(targets), np.concatenate(folds)
        many = len(true) >= MANY
        if len(np.unique(true)) == len(labels):
            self.weights_ = Weights.fit(found, true, len(labels), network=many)
        # Weights of a part of few rows are much less sure than those of all: their odds would say nothing.
        self._set_limits(found, true, fold if many else np.zeros_like(fold))

    def _set_limits(self, distances: np.ndarray, targets: np.ndarray, folds: np.ndarray) -> None:
        """Limits from gestures of the persons of each fold, weighed by what the other folds say, if there are any."""
        odds, near = [], []
        n_labels = len(self.measured_.labels)
        for fold in np.unique(folds):
            weights, others = self.weights_, folds != fold
            if len(np.unique(targets[others])) == n_labels:
                weights = Weights.fit(distances[others], targets[others], n_labels)
            for row in distances[(folds == fold) & self._is_gesture[targets]]:
                winner, against, _ = self._winner(weights, row, self._is_gesture)
                odds.append(against)
                near.append(row[winner])
        if self._is_gesture.all():  # without irrelevant motion the plain distance has to do
            self.farthest_ = float(np.quantile(near, 1 - FALSE_REJECTION))
            return
        self.limit_ = float(np.quantile(odds, 1 - FALSE_REJECTION))
        self.farthest_ = float(np.quantile(near, 1 - NEVER_SEEN))

    def _winner(self, weights: Weights, distances: np.ndarray, allowed: np.ndarray) -> tuple[int, float, np.ndarray]:
        """The most likely allowed label, the odds of irrelevant motion against it, and all shares."""
        shares = weights.shares(distances, allowed | ~self._is_gesture)
        winner = int(np.argmax(np.where(allowed, shares, -1)))
        return winner, float(shares[~self._is_gesture].sum() / max(shares[winner], 1e-12)), shares

    def decide(self, vector: np.ndarray, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Name a feature vector.

        Args:
            vector: (d,) features.
            among: labels that the context allows; irrelevant motion always competes.
            k: number of neighbours of each class, the model's own when None.
        """
        known, gesture = self.measured_, self._is_gesture
        distances = known.distances(vector[None])
        by_class = known.class_distances(distances, k or self.n_neighbors)[0]
        allowed = gesture if among is None else gesture & np.isin(known.labels, list(among))
        winner, odds, shares = self._winner(self.weights_, by_class, allowed)
        name, far = str(known.labels[winner]), float(by_class[winner])
        reason = self._reason(name, odds, far, distances[0]) if odds > self.limit_ or far > self.farthest_ else ""
        rows = known.nearest(distances[0], allowed | ~gesture, SHOWN)
        compared = not gesture.all()
        return Decision(
            None if reason else name,
            name,
            str(known.rows.families[known.rows_of[winner].start]),
            bool(reason),
            reason,
            _share(odds) if compared else far,
            _share(self.limit_) if compared else self.farthest_,
            {str(n): float(share) for n, share in zip(known.labels, shares, strict=True) if share > 0},
            tuple(neighbour(known.rows, row, float(distances[0, row])) for row in rows),
        )

    def _reason(self, name: str, odds: float, far: float, distances: np.ndarray) -> str:
        if odds <= self.limit_:
            return f"unlike anything known: nearest is {name} at distance {far:.3g}, beyond {self.farthest_:.3g}"
        kind = self.measured_.nearest_kind(distances)
        return f"irrelevant motion ({kind}) is {odds:.3g} times as likely as {name}; the limit is {self.limit_:.3g}"


def _share(odds: float) -> float:
    """Odds against a gesture as the share of what speaks against it, 0 … 1."""
    return 1 - 1 / (1 + odds)
