"""What a discriminant needs to know of rows: how many, their sums and their products, by class.

These can be added and taken away, so that leaving a person out costs that person's rows, not all the others', and a
mirrored row costs nothing: its sums are those of the row in another order.
"""

from __future__ import annotations

import dataclasses

import numpy as np


@dataclasses.dataclass(frozen=True)
class Scatter:
    """Sums over rows (n, d) of c classes, in units in which no feature is large.

    Attributes:
        origin, unit: (d,) what was taken from each feature, and what it was divided by.
        counts: (c,) rows of each class.
        sums: (c, d) of the rows of each class.
        products: (d, d) float32, sum over all rows of each row's product with itself.
    """

    origin: np.ndarray
    unit: np.ndarray
    counts: np.ndarray
    sums: np.ndarray
    products: np.ndarray

    @classmethod
    def of_rows(cls, rows: np.ndarray, index: np.ndarray, n_classes: int) -> Scatter:
        """Sum rows (n, d) of classes ``index`` (n,) in units of their own."""
        origin, unit = rows.mean(axis=0, dtype=float), rows.std(axis=0, dtype=float)
        unit = np.where(unit > 0, unit, 1.0)
        return cls.of_scaled(scaled(rows, origin, unit), index, n_classes, origin, unit)

    @classmethod
    def of_scaled(
        cls, rows: np.ndarray, index: np.ndarray, n_classes: int, origin: np.ndarray, unit: np.ndarray
    ) -> Scatter:
        """Sum rows (n, d) float32 that :func:`scaled` has brought to the units."""
        member = (index == np.arange(n_classes)[:, None]).astype(np.float32)
        return cls(origin, unit, member.sum(axis=1, dtype=float), (member @ rows).astype(float), rows.T @ rows)

    def __add__(self, other: Scatter) -> Scatter:
        return self._with(self.counts + other.counts, self.sums + other.sums, self.products + other.products)

    def __sub__(self, other: Scatter) -> Scatter:
        return self._with(self.counts - other.counts, self.sums - other.sums, self.products - other.products)

    def mirrored(self, source: np.ndarray, sign: np.ndarray, twin: np.ndarray) -> Scatter:
        """Return the sums of the rows ``sign * row[source]``, class c of which is class ``twin[c]``.

        Origin and unit must be those of a feature and its mirrored one alike.
        """
        counts, sums = np.zeros_like(self.counts), np.zeros_like(self.sums)
        np.add.at(counts, twin, self.counts)
        np.add.at(sums, twin, self.sums[:, source] * sign)
        signs = sign.astype(np.float32)
        products = self.products[source[:, None], source] * signs
        products *= signs[:, None]
        return self._with(counts, sums, products)

    def _with(self, counts: np.ndarray, sums: np.ndarray, products: np.ndarray) -> Scatter:
        return Scatter(self.origin, self.unit, counts, sums, products)

    def of_features(self, kept: np.ndarray) -> Scatter:
        """Return what is known of some features, a mask (d,)."""
        products = self.products[np.ix_(kept, kept)]
        return Scatter(self.origin[kept], self.unit[kept], self.counts, self.sums[:, kept], products)

    def mean(self) -> np.ndarray:
        """Mean of all rows, (d,)."""
        mean: np.ndarray = self.origin + self.unit * self.sums.sum(axis=0) / self.counts.sum()
        return mean

    def deviation(self) -> np.ndarray:
        """Standard deviation of all rows, (d,)."""
        n = self.counts.sum()
        mean = self.sums.sum(axis=0) / n
        variance = np.diag(self.products).astype(float) / n - mean * mean
        deviation: np.ndarray = self.unit * np.sqrt(np.maximum(variance, 0))
        return deviation

    def class_means(self) -> np.ndarray:
        """Mean of each class that has rows, (≤ c, d)."""
        present = self.counts > 0
        means: np.ndarray = self.origin + self.unit * self.sums[present] / self.counts[present, None]
        return means

    def within(self, scale: np.ndarray) -> np.ndarray:
        """Covariance of the rows about the means of their classes, of features divided by ``scale``, (d, d) float32."""
        present = self.counts > 0
        weighed = (self.sums[present] / np.sqrt(self.counts[present, None])).astype(np.float32)
        covariance: np.ndarray = self.products - weighed.T @ weighed
        ratio = (self.unit / scale / np.sqrt(self.counts.sum())).astype(np.float32)
        covariance *= ratio
        covariance *= ratio[:, None]
        return covariance


def scaled(rows: np.ndarray, origin: np.ndarray, unit: np.ndarray) -> np.ndarray:
    """Rows (n, d) in units of a scatter, float32."""
    out = rows.astype(np.float32)
    out -= origin.astype(np.float32)
    out /= unit.astype(np.float32)
    return out
