from __future__ import annotations

import numpy as np
import pytest
from sklearn.model_selection import GridSearchCV, LeaveOneGroupOut
from sklearn.neighbors import KNeighborsClassifier
from sklearn.pipeline import make_pipeline
from sklearn.preprocessing import MinMaxScaler
from sklearn.utils.estimator_checks import parametrize_with_checks

from recognizer.learning.discriminant_metric import DiscriminantMetric
from recognizer.learning.neighbour_classifier import NeighbourClassifier, mixed_distances, votes_of


@parametrize_with_checks([NeighbourClassifier(), NeighbourClassifier(3, vote="distance"), DiscriminantMetric()])
def test_scikit_learn_contract(estimator: object, check: object) -> None:
    check(estimator)  # type: ignore[operator]


@pytest.fixture(scope="module")
def blobs() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Four classes by eight persons; each person shifts all of theirs."""
    rng = np.random.default_rng(0)
    y = np.tile(np.repeat(np.arange(4), 3), 8)
    persons = np.repeat(np.arange(8), 12)
    X = rng.normal(0, 1, (96, 6)) + 3 * np.eye(4, 6)[y] + rng.normal(0, 0.7, (8, 6))[persons]
    return X, y, persons


@pytest.mark.parametrize(("k", "vote"), [(1, "majority"), (5, "distance"), (9, "distance")])
def test_equals_scikit_learn(blobs: tuple[np.ndarray, ...], k: int, vote: str) -> None:
    X, y, _ = blobs
    train, test = slice(0, 60), slice(60, None)
    theirs = make_pipeline(
        MinMaxScaler(),
        KNeighborsClassifier(k, metric="manhattan", weights="uniform" if vote == "majority" else "distance"),
    ).fit(X[train], y[train])
    ours = NeighbourClassifier(k, vote=vote).fit(X[train], y[train])
    assert (ours.predict(X[test]) == theirs.predict(X[test])).all()
    np.testing.assert_allclose(ours.predict_proba(X[test]), theirs.predict_proba(X[test]), atol=1e-9)


def test_mixed_metric_by_hand() -> None:
    queries, samples = np.array([[0.2, 1.0, 0.5]]), np.array([[0.5, 1.0, 0.0], [0.2, 2.0, 0.5]])
    weights, discrete = np.array([1.0, 2.0, 4.0]), np.array([False, True, False])
    np.testing.assert_allclose(mixed_distances(queries, samples, weights, discrete), [[0.3 + 2.0, 2.0]])


def test_votes_by_hand() -> None:
    distances, targets = np.array([[1.0, 2.0, 2.0]]), np.array([[0, 1, 1]])
    np.testing.assert_allclose(votes_of(distances, targets, 2, "majority", 1), [[1, 2]])
    np.testing.assert_allclose(votes_of(distances, targets, 2, "distance", 1), [[1, 1]])
    np.testing.assert_allclose(votes_of(distances, targets, 2, "distance", 2), [[1, 0.5]])


def test_one_class_one_sample_and_fewer_samples_than_k() -> None:
    one = NeighbourClassifier(5).fit([[0.0, 1.0]], ["bye_right"])
    assert one.predict([[3.0, 3.0]]).tolist() == ["bye_right"]
    two = NeighbourClassifier(5).fit([[0.0], [1.0]], ["a", "b"])
    assert two.kneighbors([[0.1]])[0].shape == (1, 2)


@pytest.mark.parametrize("arguments", [{"vote": "best"}, {"n_neighbors": 0}])
def test_wrong_arguments(arguments: dict[str, object]) -> None:
    with pytest.raises(ValueError, match=next(iter(arguments))):
        NeighbourClassifier(**arguments).fit([[0.0], [1.0]], [0, 1])  # type: ignore[arg-type]


def test_k_is_chosen_over_unseen_persons(blobs: tuple[np.ndarray, ...]) -> None:
    X, y, persons = blobs
    pipeline = make_pipeline(DiscriminantMetric(), NeighbourClassifier(normalize=False))
    grid = {"neighbourclassifier__n_neighbors": [1, 3, 5]}
    search = GridSearchCV(pipeline, grid, cv=LeaveOneGroupOut()).fit(X, y, groups=persons)
    assert search.best_score_ > 0.8


def test_the_metric_whitens_what_persons_of_a_class_differ_by(blobs: tuple[np.ndarray, ...]) -> None:
    X, y, _ = blobs
    stretched = X * [1, 100, 1, 0.01, 1, 1]  # units must not matter
    Z = DiscriminantMetric(1e-6).fit(stretched, y).transform(stretched)
    assert Z.shape == (96, 3)
    within = np.concatenate([Z[y == k] - Z[y == k].mean(axis=0) for k in range(4)])
    np.testing.assert_allclose(within.T @ within / len(Z), np.eye(3), atol=0.02)
