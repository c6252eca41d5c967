"""How the weights of :mod:`recognizer.person.ranking` are learned: logistic regression on columns and products."""

from __future__ import annotations

import numpy as np
from sklearn.linear_model import LogisticRegression
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import PolynomialFeatures, StandardScaler

from recognizer.person.ranking import Ranking, scaled_columns

STRENGTH = 0.03  # inverse of the pull towards equal scores


def learn(table: np.ndarray, right: np.ndarray) -> Ranking:
    """Learn from what is known of candidates (n, d), and whether each is the person (n,)."""
    mean, scale = table.mean(axis=0), table.std(axis=0) + 1e-6
    model = make_pipeline(
        PolynomialFeatures(2, include_bias=False),
        StandardScaler(),
        LogisticRegression(C=STRENGTH, max_iter=2000),
    )
    products, scaler, logistic = (step for _, step in model.fit(scaled_columns(table, mean, scale), right).steps)
    weights = logistic.coef_[0] / scaler.scale_
    size = table.shape[1]
    pairs = np.zeros((size, size))
    for weight, powers in zip(weights[size:], products.powers_[size:], strict=True):
        first, last = np.flatnonzero(powers)[[0, -1]]
        pairs[first, last] = weight
    offset = logistic.intercept_[0] - scaler.mean_ @ weights
    return Ranking(mean, scale, weights[:size], pairs, np.array(offset))
