"""How much each class's neighbours count: weights of the distances, learnt on persons the neighbours do not know.

A class whose performances vary (*stop*) lies near everything, one that is always done alike (*kowtow*) near nothing.
Weighing the logarithms of the distances makes up for it: votes 1/dⁿ with an n of its own for each pair of classes. A
small network beside it also sees which kinds of irrelevant motion are near; what the two say is averaged.
"""

from __future__ import annotations

import dataclasses
import warnings
from collections.abc import Mapping

import numpy as np
from sklearn.exceptions import ConvergenceWarning
from sklearn.linear_model import LogisticRegression
from sklearn.neural_network import MLPClassifier

from recognizer.networks.hidden_layer import HiddenLayer

STRENGTH = 1.0  # inverse of the pull towards equal weights
HIDDEN, DECAY, ROUNDS = 96, 0.3, 40  # units of the network, pull of its weights towards 0, times it sees every row
FARTHEST = 20.0  # logarithm that stands for a class without rows


@dataclasses.dataclass(frozen=True)
class Weights:
    """What a set of distances says about each label.

    A row of distances holds, for L labels and K kinds of irrelevant motion, the mean of the k nearest rows of each
    label, the mean of its 3k nearest, and the mean of the k nearest rows of each kind: (2L + K,).

    Attributes:
        coefficients: (n_labels, n_inputs) multinomial logistic weights of the labels' inputs.
        offsets: (n_labels,).
        network: reads the kinds of irrelevant motion, too; None where nothing could be learnt.
    """

    coefficients: np.ndarray
    offsets: np.ndarray
    network: HiddenLayer | None = None

    @classmethod
    def plain(cls, n_labels: int, n_kinds: int, power: float) -> Weights:
        """Votes 1/dⁿ from the first distance of each label."""
        coefficients = np.zeros((n_labels, 2 * n_labels + bool(n_kinds)))
        coefficients[:, :n_labels] = power * np.eye(n_labels)
        return cls(coefficients, np.zeros(n_labels))

    @classmethod
    def fit(cls, distances: np.ndarray, targets: np.ndarray, n_labels: int, network: bool = True) -> Weights:
        """Learn from distances (n, 2·n_labels + n_kinds) of clips of labels ``targets`` (n,), all labels among them.

        Without ``network`` the linear weights stand alone.
        """
        labels, every = nearness(distances, n_labels)
        linear = LogisticRegression(C=STRENGTH, max_iter=5000, tol=1e-3)
        mean, spread = labels.mean(axis=0), labels.std(axis=0) + 1e-6
        linear.fit((labels - mean) / spread, targets)
        coefficients, offsets = _two_sided(linear.coef_.T / spread[:, None], linear.intercept_)
        offsets = offsets - mean @ coefficients
        if not network:
            return cls(coefficients.T, offsets)
        layers = MLPClassifier((HIDDEN,), alpha=DECAY, max_iter=ROUNDS, random_state=0)
        mean, spread = every.mean(axis=0), every.std(axis=0) + 1e-6
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", ConvergenceWarning)  # it is stopped early on purpose
            layers.fit(((every - mean) / spread).astype(np.float32), targets)
        units = HiddenLayer.of(layers, mean, spread)
        output, output_offsets = _two_sided(units.output, units.output_offsets)
        units = dataclasses.replace(units, output=output, output_offsets=output_offsets)
        return cls(coefficients.T, offsets, units)

    @property
    def arrays(self) -> dict[str, np.ndarray]:
        """All weights by name, to be stored."""
        network = {} if self.network is None else dataclasses.asdict(self.network)
        return {"linear": self.coefficients, "linear_offsets": self.offsets, **network}

    @classmethod
    def of_arrays(cls, arrays: Mapping[str, np.ndarray]) -> Weights:
        """Return the weights whose :attr:`arrays` were stored."""
        names = [field.name for field in dataclasses.fields(HiddenLayer)]
        network = HiddenLayer(*(arrays[name] for name in names)) if names[0] in arrays else None
        return cls(arrays["linear"], arrays["linear_offsets"], network)

    def shares(self, distances: np.ndarray, allowed: np.ndarray) -> np.ndarray:
        """Return each label's share (n_labels,) of the votes, 0 where not ``allowed``."""
        labels, every = nearness(distances[None], len(self.offsets))
        logits = labels[0] @ self.coefficients.T + self.offsets
        if self.network is not None:
            logits = (logits + self.network(every)[0]) / 2
        votes = np.where(allowed, np.exp(logits - logits[allowed].max()), 0.0)
        return votes / votes.sum()


def _two_sided(weights: np.ndarray, offsets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Weights (d, n_labels) and offsets; two labels share one column, which is given to both."""
    if weights.shape[1] > 1:
        return weights, offsets
    return np.hstack([-weights, weights]) / 2, np.append(-offsets, offsets) / 2


def nearness(distances: np.ndarray, n_labels: int) -> tuple[np.ndarray, np.ndarray]:
    """Minus the logarithm of distances, from its mean: twice as far from all is the same.

    Args:
        distances: (n, 2·n_labels + n_kinds).
        n_labels: number of labels.

    Returns:
        of the labels and the nearest kind, for the linear weights; of the labels and all kinds, for the network.
    """
    logs = -np.log(np.clip(distances, 1e-6, np.exp(FARTHEST)))
    labels, kinds = np.split(logs, [2 * n_labels], axis=1)
    if kinds.shape[1]:
        labels = np.column_stack([labels, kinds.max(axis=1)])
    mean = labels.mean(axis=1, keepdims=True)
    return labels - mean, np.hstack([labels, kinds]) - mean
