"""Rows in a discriminant metric: how far a vector is from each label, and from each kind of irrelevant motion."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from recognizer.database import IRRELEVANT, Rows
from recognizer.mirror import mirrored_map

WIDER = 3  # times as many neighbours tell how dense a class is around
BATCH = 500  # vectors whose distances are worked out at a time


class Metric(NamedTuple):
    """Mean (d,), scale (d,) and components (d, c): a vector x is brought to ``(x - mean) / scale @ components``."""

    mean: np.ndarray
    scale: np.ndarray
    components: np.ndarray


class MeasuredRows:
    """Rows as a metric sees them, those of one label together.

    Args:
        metric: as learned.
        rows: what is known of each row; where ``mirror`` is set, the mirrored rows after all others.
        features: (n, d) of the rows that are not mirrored.
        mirror: whether every row stands for its mirror image as well.

    Attributes:
        rows: sorted by label, and irrelevant ones by kind.
        labels: (n_labels,) sorted.
        kinds: (n_kinds,) of irrelevant motion, sorted.
        rows_of: the rows of each label.
    """

    def __init__(self, metric: Metric, rows: Rows, features: np.ndarray, mirror: bool) -> None:
        self.metric = metric
        # In single precision and one product: a database is projected in a tenth of a second.
        self._map = (metric.components / metric.scale[:, None]).astype(np.float32)
        self._origin = (metric.mean @ (metric.components / metric.scale[:, None])).astype(np.float32)
        projected = self.project(features)
        if mirror:
            projected = np.concatenate([projected, features @ mirrored_map(self._map) - self._origin])
        order = np.lexsort((rows.actions, rows.labels))
        self.rows = rows.take(order)
        self._projected = projected[order]
        self._squares = np.einsum("nc,nc->n", self._projected, self._projected)
        self.labels, first, counts = np.unique(self.rows.labels, return_index=True, return_counts=True)
        self.rows_of = [slice(start, start + count) for start, count in zip(first, counts, strict=True)]
        irrelevant = np.flatnonzero(self.rows.labels == IRRELEVANT)
        actions = self.rows.actions[irrelevant]
        self.kinds, first, self._of_kind = np.unique(actions, return_index=True, return_counts=True)
        # Rows of each kind (n_kinds, largest); the shorter ones repeat their last, which does not count.
        place = np.arange(self._of_kind.max(initial=0))
        self._kind_rows = irrelevant[first[:, None] + np.minimum(place, self._of_kind[:, None] - 1)]
        self._no_row = place >= self._of_kind[:, None]

    def project(self, vectors: np.ndarray) -> np.ndarray:
        """Bring feature vectors (n, d) into the metric, (n, c) float32."""
        projected: np.ndarray = vectors.astype(np.float32, copy=False) @ self._map - self._origin
        return projected

    def distances(self, vectors: np.ndarray) -> np.ndarray:
        """Distance of feature vectors (n, d) to every row, (n, n_rows)."""
        places = self.project(vectors)
        squares = places @ self._projected.T
        squares *= -2
        squares += self._squares
        squares += np.einsum("nc,nc->n", places, places)[:, None]
        np.maximum(squares, 0, out=squares)
        return np.sqrt(squares, out=squares)

    def class_distances(self, distances: np.ndarray, k: int) -> np.ndarray:
        """Mean distance of the k and the 3k nearest rows of each label, and of the k nearest of each kind.

        From (n, n_rows) to (n, 2·n_labels + n_kinds), as :class:`recognizer.weighing.Weights` reads them.
        """
        labels = len(self.labels)
        out = np.empty((len(distances), 2 * labels + len(self.kinds)))
        for target, rows in enumerate(self.rows_of):
            own = distances[:, rows]
            wide = min(WIDER * k, own.shape[1])
            nearest = np.sort(np.partition(own, wide - 1, axis=1)[:, :wide], axis=1)
            out[:, target] = nearest[:, :k].sum(axis=1) / min(k, wide)
            out[:, labels + target] = nearest.sum(axis=1) / wide
        if len(self.kinds):
            own = distances[:, self._kind_rows]
            own[:, self._no_row] = np.inf
            few = min(k, own.shape[2])
            nearest = np.partition(own, few - 1, axis=2)[:, :, :few]
            nearest[np.isinf(nearest)] = 0
            out[:, 2 * labels :] = nearest.sum(axis=2) / np.minimum(few, self._of_kind)
        return out

    def distances_as(self, other: MeasuredRows, vectors: np.ndarray, k: int) -> np.ndarray:
        """Class distances of vectors (n, d), for the labels and kinds of ``other``; infinite to what is not here."""
        labels = len(other.labels)
        out = np.full((len(vectors), 2 * labels + len(other.kinds)), np.inf)
        places, kinds = np.searchsorted(other.labels, self.labels), np.searchsorted(other.kinds, self.kinds)
        columns = np.concatenate([places, labels + places, 2 * labels + kinds])
        for first in range(0, len(vectors), BATCH):
            batch = slice(first, first + BATCH)
            out[batch, columns] = self.class_distances(self.distances(vectors[batch]), k)
        return out

    def nearest(self, distances: np.ndarray, labels: np.ndarray, count: int) -> list[int]:
        """Return the nearest ``count`` rows of the labels of a mask, nearest first."""
        competing = distances.copy()
        for rows in itertools.compress(self.rows_of, ~labels):
            competing[rows] = np.inf
        near = np.argpartition(competing, min(count, len(competing)) - 1)[:count]
        nearest: list[int] = near[np.argsort(competing[near])].tolist()
        return nearest

    def nearest_kind(self, distances: np.ndarray) -> str:
        """What irrelevant motion the nearest irrelevant row shows."""
        rows = self.rows_of[int(np.searchsorted(self.labels, IRRELEVANT))]
        return str(self.rows.actions[rows.start + int(np.argmin(distances[rows]))])
