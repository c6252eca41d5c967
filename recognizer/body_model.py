"""The default model: a learnt metric, each class's nearest neighbours in it, weighed; limits from unseen persons."""

from __future__ import annotations

import itertools
from collections.abc import Callable

import numpy as np

from recognizer.database import IRRELEVANT, Database
from recognizer.decision import SHOWN, Decision, neighbour
from recognizer.known import KnownRows
from recognizer.mirror import mirrored_map, twins
from recognizer.weighing import Weights

NEIGHBOURS = 5
WIDER = 3  # times as many neighbours tell how dense a class is around
POWER = 2.0  # n of the votes 1/dⁿ where no weights could be learnt
SHRINKAGE = 0.3
FALSE_REJECTION = 0.03  # share of true gestures of unseen persons that the limit gives up
NEVER_SEEN = 0.002  # share of them that is further from its gesture than anything answered
BATCH = 500  # vectors whose distances are worked out at a time


class BodyModel:
    """Weighed neighbours in a discriminant metric.

    Every class is measured by the mean distance of its k and its 3k nearest rows, so that a class with many clips has
    no more say than one with few; weights of these distances, learnt on persons whose rows were left out, give each
    class its share. A gesture is rejected when irrelevant motion is too likely beside it, and when it is further
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
        if "components" not in stored:
            return self._learn(KnownRows(database), np.ones(len(database), bool))
        self.rows = database.rows
        if database.mirror:
            self.rows = self.rows.with_others(twins(database))
        metric = stored["mean"], stored["scale"], stored["components"].astype(np.float32)
        self._measure(*metric, database.features, bool(database.mirror))
        self.weights_ = Weights(stored["coefficients"], stored["offsets"])
        self.limit_, self.farthest_ = float(stored["limit"]), float(stored["farthest"])
        return self

    def _learn(self, known: KnownRows, used: np.ndarray) -> BodyModel:
        self._learn_metric(known, used)
        self._learn_weights(known, used)
        return self

    def _learn_metric(self, known: KnownRows, used: np.ndarray) -> None:
        self.rows = known.rows(used)
        features = known.database.features[used]
        self._measure(*known.metric(used, self.shrinkage), features, bool(known.database.mirror))

    def _measure(
        self, mean: np.ndarray, scale: np.ndarray, components: np.ndarray, features: np.ndarray, mirror: bool
    ) -> None:
        self._mean, self._scale, self._components = mean, scale, components
        # In single precision and one product: a database is projected in a tenth of a second.
        self._map = (components / scale[:, None]).astype(np.float32)
        self._origin = (mean @ (components / scale[:, None])).astype(np.float32)
        projected = self.project(features)
        if mirror:
            projected = np.concatenate([projected, features @ mirrored_map(self._map) - self._origin])
        # Rows of one label stand together, so that each label is a slice.
        order = np.argsort(self.rows.labels, kind="stable")
        self.rows = self.rows.take(order)
        self._projected = projected[order]
        self._squares = np.einsum("nc,nc->n", self._projected, self._projected)
        self._labels, first, counts = np.unique(self.rows.labels, return_index=True, return_counts=True)
        self._rows_of = [slice(start, start + count) for start, count in zip(first, counts, strict=True)]

    def project(self, vectors: np.ndarray) -> np.ndarray:
        """Bring feature vectors (n, d) into the metric, (n, c) float32."""
        projected: np.ndarray = vectors.astype(np.float32, copy=False) @ self._map - self._origin
        return projected

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """What was learned, to be stored beside the rows."""
        return {
            "mean": self._mean.astype(np.float32),
            "scale": self._scale.astype(np.float32),
            "components": self._components.astype(np.float16),
            "coefficients": self.weights_.coefficients,
            "offsets": self.weights_.offsets,
            "limit": np.array(self.limit_),
            "farthest": np.array(self.farthest_),
        }

    def _learn_weights(self, known: KnownRows, used: np.ndarray) -> None:
        """Weights and limits from persons whose rows are left out, by folds over persons."""
        self.weights_, self.limit_, self.farthest_ = Weights.plain(len(self._labels), POWER), np.inf, np.inf
        groups = np.unique(known.groups[used])
        if len(groups) < 2 or len(self._labels) < 2:
            return
        distances, targets = [], []
        for group in groups:
            unseen = used & (known.groups == group)
            model = BodyModel(self.n_neighbors, self.shrinkage)
            model._learn_metric(known, used & ~unseen)
            distances.append(model._distances_to(self._labels, known.database.features[unseen]))
            targets.append(np.searchsorted(self._labels, known.database.labels[unseen]))
        found, true = np.concatenate(distances), np.concatenate(targets)
        if len(np.unique(true)) == len(self._labels):
            self.weights_ = Weights.fit(found, true)
        self._set_limits(found, true)

    def _set_limits(self, distances: np.ndarray, targets: np.ndarray) -> None:
        if IRRELEVANT not in self._labels:
            return
        gestures = distances[self._labels[targets] != IRRELEVANT]
        winners = [self._winner(row, self._labels != IRRELEVANT) for row in gestures]
        self.limit_ = float(np.quantile([odds for _, odds, _ in winners], 1 - FALSE_REJECTION))
        near = [row[winner] for row, (winner, _, _) in zip(gestures, winners, strict=True)]
        self.farthest_ = float(np.quantile(near, 1 - NEVER_SEEN))

    def _distances_to(self, labels: np.ndarray, vectors: np.ndarray) -> np.ndarray:
        """Distances of each vector (n, d) to each of ``labels``, (n, 2·n_labels); infinite to those not known."""
        out = np.full((len(vectors), 2, len(labels)), np.inf)
        places = np.searchsorted(labels, self._labels)
        for first in range(0, len(vectors), BATCH):
            batch = slice(first, first + BATCH)
            out[batch, :, places] = self._class_distances(self._distances(vectors[batch]), self.n_neighbors)
        return out.reshape(len(vectors), -1)

    def _distances(self, vectors: np.ndarray) -> np.ndarray:
        """Distance of feature vectors (n, d) to every row, (n, n_rows)."""
        places = self.project(vectors)
        squares = places @ self._projected.T
        squares *= -2
        squares += self._squares
        squares += np.einsum("nc,nc->n", places, places)[:, None]
        np.maximum(squares, 0, out=squares)
        return np.sqrt(squares, out=squares)

    def _class_distances(self, distances: np.ndarray, k: int) -> np.ndarray:
        """Mean distance of the k and the 3k nearest rows of each label: (n, n_rows) to (n, 2, n_labels)."""
        out = np.empty((len(distances), 2, len(self._labels)))
        for target, rows in enumerate(self._rows_of):
            own = distances[:, rows]
            wide = min(WIDER * k, own.shape[1])
            nearest = np.sort(np.partition(own, wide - 1, axis=1)[:, :wide], axis=1)
            out[:, 0, target] = nearest[:, :k].sum(axis=1) / min(k, wide)
            out[:, 1, target] = nearest.sum(axis=1) / wide
        return out

    def _winner(self, distances: np.ndarray, allowed: np.ndarray) -> tuple[int, float, np.ndarray]:
        """The most likely allowed label, the odds of irrelevant motion against it, and all shares."""
        irrelevant = self._labels == IRRELEVANT
        shares = self.weights_.shares(distances, allowed | irrelevant)
        winner = int(np.argmax(np.where(allowed, shares, -1)))
        return winner, float(shares[irrelevant].sum() / max(shares[winner], 1e-12)), shares

    def decide(self, vector: np.ndarray, among: set[str] | None = None, k: int | None = None) -> Decision:
        """Name a feature vector.

        Args:
            vector: (d,) features.
            among: labels that the context allows; irrelevant motion always competes.
            k: number of neighbours of each class, the model's own when None.
        """
        distances = self._distances(vector[None])
        by_class = self._class_distances(distances, k or self.n_neighbors).ravel()
        distances = distances[0]
        allowed = self._labels != IRRELEVANT
        if among is not None:
            allowed &= np.isin(self._labels, list(among))
        winner, odds, shares = self._winner(by_class, allowed)
        name, far = str(self._labels[winner]), float(by_class[winner])
        # Without irrelevant motion in the database the plain distance has to do.
        known = IRRELEVANT in self._labels
        reason = self._reason(name, odds, far, distances) if odds > self.limit_ or far > self.farthest_ else ""
        shown = self._nearest(distances, allowed | (self._labels == IRRELEVANT))
        return Decision(
            None if reason else name,
            name,
            str(self.rows.families[self._rows_of[winner].start]),
            bool(reason),
            reason,
            _share(odds) if known else far,
            _share(self.limit_) if known else np.inf,
            {str(n): float(share) for n, share in zip(self._labels, shares, strict=True) if share > 0},
            tuple(neighbour(self.rows, row, float(distances[row])) for row in shown),
        )

    def _nearest(self, distances: np.ndarray, labels: np.ndarray) -> list[int]:
        """Return the nearest rows of the labels of a mask, nearest first."""
        competing = distances.copy()
        for rows in itertools.compress(self._rows_of, ~labels):
            competing[rows] = np.inf
        near = np.argpartition(competing, min(SHOWN, len(competing)) - 1)[:SHOWN]
        nearest: list[int] = near[np.argsort(competing[near])].tolist()
        return nearest

    def _reason(self, name: str, odds: float, far: float, distances: np.ndarray) -> str:
        if odds <= self.limit_:
            return f"unlike anything known: nearest is {name} at distance {far:.3g}, beyond {self.farthest_:.3g}"
        irrelevant = self._rows_of[int(np.searchsorted(self._labels, IRRELEVANT))]
        action = self.rows.actions[irrelevant.start + int(np.argmin(distances[irrelevant]))]
        return f"irrelevant motion ({action}) is {odds:.3g} times as likely as {name}; the limit is {self.limit_:.3g}"


def _share(odds: float) -> float:
    """Odds against a gesture as the share of what speaks against it, 0 … 1."""
    return 1 - 1 / (1 + odds)
