"""Rows in a discriminant metric: how far a vector is from each label, and from each kind of irrelevant motion."""

from __future__ import annotations

import itertools
from typing import NamedTuple

import numpy as np

from recognizer.learning.database import IRRELEVANT, Rows
from recognizer.learning.mirror import mirrored, mirrored_map

WIDER = 3  # times as many neighbours tell how dense a class is around
SIMILAR = 3  # times as many rows may one kind have as another beside which it is looked at
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
        self._low, self._high = _ranges(features, mirror)
        projected = self.project(features)
        if mirror:
            projected = np.concatenate([projected, features @ mirrored_map(self._map) - self._origin])
        order = np.lexsort((rows.actions, rows.labels))
        self.rows = rows.take(order)
        self._projected = projected[order]
        self._squares = np.einsum("nc,nc->n", self._projected, self._projected)
        self.labels, self.rows_of = _slices(self.rows.labels)
        irrelevant = np.flatnonzero(self.rows.labels == IRRELEVANT)
        self.kinds, rows_of_kind = _slices(self.rows.actions[irrelevant], irrelevant.min(initial=len(order)))
        self._kinds_by_size = _by_size(rows_of_kind, len(order))

    def project(self, vectors: np.ndarray) -> np.ndarray:
        """Bring feature vectors (n, d) into the metric, (n, c) float32; no feature leads further than the rows do.

        What a camera or a room makes larger than any row has it would weigh as much as it likes.
        """
        within = np.clip(vectors.astype(np.float32, copy=False), self._low, self._high)
        projected: np.ndarray = within @ self._map - self._origin
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

        From (n, n_rows) to (n, 2·n_labels + n_kinds), as :mod:`recognizer.learning.distance_weights` reads them.
        """
        labels = len(self.labels)
        out = np.empty((len(distances), 2 * labels + len(self.kinds)))
        for target, rows in enumerate(self.rows_of):
            nearest = _nearest(distances[:, rows], WIDER * k)
            nearest.sort(axis=1)
            out[:, target] = np.add.reduce(nearest[:, :k], axis=1) / min(k, nearest.shape[1])
            out[:, labels + target] = np.add.reduce(nearest, axis=1) / nearest.shape[1]
        beyond = np.column_stack([distances, np.full(len(distances), np.inf, distances.dtype)])
        for kinds, places, sizes in self._kinds_by_size:
            nearest = _nearest(beyond[:, places], k)
            total = np.add.reduce(nearest, axis=-1, where=nearest < np.inf)
            out[:, 2 * labels + kinds] = total / np.minimum(sizes, k)
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
        nearest = []
        for _ in range(min(count, len(competing))):  # a few times the smallest is quicker than a partition
            nearest.append(int(competing.argmin()))
            competing[nearest[-1]] = np.inf
        return nearest

    def nearest_kind(self, distances: np.ndarray) -> str:
        """What irrelevant motion the nearest irrelevant row shows."""
        rows = self.rows_of[int(np.searchsorted(self.labels, IRRELEVANT))]
        return str(self.rows.actions[rows.start + int(np.argmin(distances[rows]))])


def _ranges(features: np.ndarray, mirror: bool) -> tuple[np.ndarray, np.ndarray]:
    """Lowest and highest value (d,) of each feature among rows (n, d), and their mirrored rows as well."""
    ends = np.stack([features.min(axis=0), features.max(axis=0)]).astype(np.float32)
    if mirror:
        ends = np.concatenate([ends, mirrored(ends).astype(np.float32)])
    return ends.min(axis=0), ends.max(axis=0)


def _slices(names: np.ndarray, start: int = 0) -> tuple[np.ndarray, list[slice]]:
    """The names that occur, and the places of each, from ``start`` on; equal names stand together."""
    found, first, counts = np.unique(names, return_index=True, return_counts=True)
    return found, [slice(start + i, start + i + n) for i, n in zip(first.tolist(), counts.tolist(), strict=True)]


def _by_size(slices: list[slice], beyond: int) -> list[tuple[np.ndarray, np.ndarray, np.ndarray]]:
    """Slices of similar size together, so that many are looked at in one go.

    Returns:
        of each group the slices' numbers (g,), the places in each (g, longest), ``beyond`` where there are no more,
        and their sizes (g,).
    """
    sizes = np.array([rows.stop - rows.start for rows in slices], int)
    groups = []
    left = np.argsort(sizes, kind="stable")
    while len(left):
        alike = sizes[left] <= SIMILAR * sizes[left[0]]
        numbers, left = left[alike], left[~alike]
        within = np.arange(sizes[numbers].max())
        starts = np.array([slices[number].start for number in numbers])
        places = np.where(within < sizes[numbers, None], starts[:, None] + within, beyond)
        groups.append((numbers, places, sizes[numbers]))
    return groups


def _nearest(distances: np.ndarray, count: int) -> np.ndarray:
    """The ``count`` smallest along the last axis, or all, in no order."""
    count = min(count, distances.shape[-1])
    ordered = distances.copy()  # many small ones: what wraps NumPy's own methods would take as long as they do
    ordered.partition(count - 1, axis=-1)
    smallest: np.ndarray = ordered[..., :count]
    return smallest
