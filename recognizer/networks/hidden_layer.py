"""A layer of rectified units between inputs and outputs: trained by scikit-learn, applied by two products."""

from __future__ import annotations

import dataclasses

import numpy as np
from sklearn.neural_network import MLPClassifier


@dataclasses.dataclass(frozen=True)
class HiddenLayer:
    """One hidden layer of h units: weights and offsets of both layers.

    Attributes:
        hidden, hidden_offsets: (d, h) and (h,), of the inputs as they come.
        output, output_offsets: (h, c) and (c,); c is 1 where there are two classes.
    """

    hidden: np.ndarray
    hidden_offsets: np.ndarray
    output: np.ndarray
    output_offsets: np.ndarray

    @classmethod
    def of(cls, trained: MLPClassifier, mean: np.ndarray, spread: np.ndarray | float) -> HiddenLayer:
        """Return what was trained on inputs (d,) less their ``mean`` and divided by their ``spread``."""
        (hidden, output), (hidden_offsets, output_offsets) = trained.coefs_, trained.intercepts_
        hidden = hidden / np.reshape(spread, (-1, 1))
        return cls(hidden, hidden_offsets - mean @ hidden, output, output_offsets)

    def __call__(self, inputs: np.ndarray) -> np.ndarray:
        """Logarithms of the classes' shares of (n, d) but for a constant of each row, (n, c); of odds where c is 1."""
        units = np.maximum(inputs @ self.hidden + self.hidden_offsets, 0)
        out: np.ndarray = units @ self.output + self.output_offsets
        return out
