"""Which of a clip's candidates is the person? A quadratic score of what is known of each.

Whether a place that looks like a head is one depends on its size, on what moves there, and on both together: linear
weights choose wrongly a third more often.
"""

from __future__ import annotations

import dataclasses
import functools
from importlib.resources import files
from pathlib import Path
from typing import Any

import numpy as np

FARTHEST = 4.0  # deviations from the mean: what is further off than training ever was counts as this far
FILE = "ranking.npz"


@dataclasses.dataclass(frozen=True)
class Ranking:
    """Weights of each column and of each pair of columns.

    Attributes:
        mean, scale: (d,) of the columns.
        linear: (d,) weights of the columns, scaled.
        pairs: (d, d) of the products of two.
        offset: above 0 is more likely the person than not.
    """

    mean: np.ndarray
    scale: np.ndarray
    linear: np.ndarray
    pairs: np.ndarray
    offset: np.ndarray

    @classmethod
    def load(cls) -> Ranking:
        """Read the shipped weights."""
        return _shipped()

    def save(self, path: Path) -> None:
        """Write the weights, a few kB."""
        np.savez_compressed(path, **self.arrays)

    @property
    def arrays(self) -> dict[str, Any]:
        """All weights by name, in single precision."""
        return {name: value.astype(np.float32) for name, value in dataclasses.asdict(self).items()}

    def __call__(self, table: np.ndarray) -> np.ndarray:
        """Scores (n,) of candidates (n, d)."""
        columns = scaled_columns(table, self.mean, self.scale)
        scores: np.ndarray = ((columns @ self.pairs + self.linear) * columns).sum(axis=1) + self.offset
        return scores


def scaled_columns(table: np.ndarray, mean: np.ndarray, scale: np.ndarray) -> np.ndarray:
    """What is known of candidates (n, d) in deviations from the mean, none beyond FARTHEST."""
    scaled: np.ndarray = ((table - mean) / scale).clip(-FARTHEST, FARTHEST)
    return scaled


@functools.lru_cache
def _shipped() -> Ranking:
    with files("recognizer.person").joinpath(FILE).open("rb") as file, np.load(file) as stored:
        return Ranking(**{name: stored[name] for name in stored.files})
