"""Rows by folds of persons, each with its mirrored twin, and the sums that make leaving persons out quick."""

from __future__ import annotations

import functools
import operator

import numpy as np

from recognizer.learning.database import IRRELEVANT, Database, Rows
from recognizer.learning.discriminant_metric import DiscriminantMetric
from recognizer.learning.mirror import asked, mirror_map, twins
from recognizer.learning.scatter_matrices import Scatter, scaled

FOLDS = 6  # groups of persons


class KnownRows:
    """All rows of a database; models are learned from some of them.

    Args:
        database: with mirror labels, or without: then no row has a twin.

    Attributes:
        database: the rows as they are.
        groups: (n,) group of each row's person, 0 … 5.
    """

    def __init__(self, database: Database) -> None:
        self.database = database
        self.groups = np.unique(database.persons, return_inverse=True)[1] % FOLDS
        own = metric_classes(database.rows)
        self._twins = twins(database) if database.mirror else None
        other = own if self._twins is None else metric_classes(self._twins)
        self.classes, index = np.unique(np.concatenate([own, other]), return_inverse=True)
        self._index, turned = np.split(index, 2)
        self._twin_class = np.arange(len(self.classes))
        self._twin_class[self._index] = turned
        self._origin, self._unit = self._units()
        self._scaled = scaled(database.features, self._origin, self._unit)
        self._by_group = {int(group): self._of(self.groups == group) for group in np.unique(self.groups)}
        self._total = functools.reduce(operator.add, self._by_group.values())

    def _units(self) -> tuple[np.ndarray, np.ndarray]:
        """Origin and unit of each feature, those of the mirrored one alike."""
        features = self.database.features
        origin, unit = features.mean(axis=0, dtype=float), features.std(axis=0, dtype=float)
        if self._twins is not None:
            source, sign = mirror_map()
            origin, unit = (origin + sign * origin[source]) / 2, (unit + unit[source]) / 2
        return origin, np.where(unit > 0, unit, 1.0)

    def rows(self, used: np.ndarray) -> Rows:
        """Rows of the mask ``used`` (n,), their twins after them."""
        own = self.database.rows.take(used)
        return own if self._twins is None else own.with_others(self._twins.take(used))

    def metric(self, rows: np.ndarray, shrinkage: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Learn mean (d,), scale (d,) and components (d, c) from ``rows`` (n,) bool and their twins.

        Components are 0 for what only rows have (:func:`recognizer.learning.mirror.asked`).
        """
        scatter = self._sums(rows)
        if self._twins is not None:
            scatter = scatter + scatter.mirrored(*mirror_map(), self._twin_class)
        size, used = len(self._unit), asked()
        scale, components = scatter.deviation() + 1e-3, np.eye(size)[:, used] / np.sqrt(np.count_nonzero(used))
        if np.count_nonzero(scatter.counts) > 1:  # else nothing to tell apart: every feature counts by its own spread
            metric = DiscriminantMetric(shrinkage).fit_scatter(scatter.of_features(used))
            scale[used], components = metric.scale_, np.zeros((size, metric.components_.shape[1]))
            components[used] = metric.components_
        return scatter.mean(), scale, components

    def _sums(self, used: np.ndarray) -> Scatter:
        """Sums over the rows ``used``: of all rows, less whole groups, less what else is missing."""
        total, missing = self._total, ~used
        for group in range(FOLDS):
            whole = self.groups == group
            if whole.any() and missing[whole].all():
                total, missing = total - self._by_group[group], missing & ~whole
        return total - self._of(missing) if missing.any() else total

    def _of(self, rows: np.ndarray) -> Scatter:
        return Scatter.of_scaled(self._scaled[rows], self._index[rows], len(self.classes), self._origin, self._unit)


def metric_classes(rows: Rows) -> np.ndarray:
    """Classes that the metric separates: gestures, and each kind of irrelevant motion by itself."""
    return np.where(rows.labels == IRRELEVANT, np.char.add("irrelevant:", rows.actions), rows.labels)
