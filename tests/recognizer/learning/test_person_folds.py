"""Sums over rows: adding and taking away, mirroring, and the same metric as from the rows themselves."""

from __future__ import annotations

import numpy as np
import pytest

from recognizer.learning.body_model import BodyModel
from recognizer.learning.discriminant_metric import DiscriminantMetric
from recognizer.learning.mirror import asked, mirrored, mirrored_map
from recognizer.learning.person_folds import KnownRows
from recognizer.learning.scatter_matrices import Scatter, scaled
from tests.recognizer.learning.test_database import database


@pytest.fixture
def rows() -> tuple[np.ndarray, np.ndarray]:
    rng = np.random.default_rng(0)
    index = rng.integers(0, 4, 120)
    return (rng.normal(0, [1, 10, 0.1], (120, 3)) + index[:, None] + [5, -50, 0]).astype(np.float32), index


def sums(rows: np.ndarray, index: np.ndarray) -> Scatter:
    origin, unit = np.array([5.0, -45.0, 1.0]), np.array([1.0, 8.0, 0.5])
    return Scatter.of_scaled(scaled(rows, origin, unit), index, 4, origin, unit)


def test_sums_tell_mean_deviation_and_covariance_within(rows: tuple[np.ndarray, np.ndarray]) -> None:
    values, index = rows
    scatter = sums(values, index)
    np.testing.assert_allclose(scatter.mean(), values.mean(axis=0), rtol=1e-4)
    np.testing.assert_allclose(scatter.deviation(), values.std(axis=0), rtol=1e-4)
    means = np.array([values[index == c].mean(axis=0) for c in range(4)])
    np.testing.assert_allclose(scatter.class_means(), means, rtol=1e-4)
    scale = np.array([2.0, 3.0, 0.5])
    apart = (values - means[index]) / scale
    np.testing.assert_allclose(scatter.within(scale), apart.T @ apart / len(values), rtol=1e-3, atol=1e-4)


def test_what_was_added_can_be_taken_away(rows: tuple[np.ndarray, np.ndarray]) -> None:
    values, index = rows
    first, rest = sums(values[:50], index[:50]), sums(values[50:], index[50:])
    for got, want in ((first + rest, sums(values, index)), (sums(values, index) - first, rest)):
        assert got.counts.tolist() == want.counts.tolist()
        np.testing.assert_allclose(got.sums, want.sums, atol=1e-3)
        np.testing.assert_allclose(got.products, want.products, rtol=1e-4, atol=1e-3)


def test_a_map_for_mirrored_vectors_needs_no_mirrored_vectors() -> None:
    features = database(2).features
    maps = np.random.default_rng(0).normal(size=(features.shape[1], 5)).astype(np.float32)
    np.testing.assert_allclose(features @ mirrored_map(maps), mirrored(features) @ maps, rtol=1e-3, atol=1e-3)


def test_leaving_rows_out_is_learning_without_them() -> None:
    """Sums less a person's and mirrored sums, against the plain metric of the remaining rows and mirrored rows."""
    made = database(5)
    used = (made.persons != "p1") & (np.arange(len(made)) != 3)
    known = KnownRows(made)
    mean, scale, components = known.metric(used, 0.3)
    left, seen = made.features[used], asked()
    both = np.concatenate([left, mirrored(left)])
    kept = known.rows(used)
    classes = np.where(kept.labels == "irrelevant", kept.actions, kept.labels)
    plain = DiscriminantMetric(0.3).fit(both[:, seen], classes)
    np.testing.assert_allclose(mean[seen], plain.mean_, atol=1e-4)
    np.testing.assert_allclose(scale[seen], plain.scale_, rtol=1e-3)
    assert not components[~seen].any()
    assert 0 < np.count_nonzero(~seen) < np.count_nonzero(seen) / 20
    ours, theirs = (left - mean) / scale @ components, plain.transform(left[:, seen])
    apart = [np.linalg.norm(z[:, None] - z[None], axis=2) for z in (ours, theirs)]
    np.testing.assert_allclose(apart[0], apart[1], rtol=0.02, atol=0.02)


def test_hardly_any_shrinkage_and_fewer_rows_than_features() -> None:
    rng = np.random.default_rng(0)
    index = np.arange(50) % 4
    values = rng.normal(size=(50, 20)) @ rng.normal(size=(20, 500)) + index[:, None] * rng.normal(size=500)
    places = DiscriminantMetric(1e-6).fit(values.astype(np.float32), index).transform(values)
    assert np.isfinite(places).all()


def test_a_learner_answers_as_a_model_of_the_rows_alone() -> None:
    made = database(4)
    used = made.persons != "p3"
    one, other = BodyModel.learner(made)(used), BodyModel().fit(made.take(used))
    for vector in made.features[~used]:
        a, b = one.decide(vector), other.decide(vector)
        assert (a.nearest, a.rejected) == (b.nearest, b.rejected)
    # Two rows may be as near but for rounding, so that the first neighbour is no matter; all distances are.
    asked_about = made.features[~used]
    assert one.measured_.rows.sources.tolist() == other.measured_.rows.sources.tolist()
    here, there = (model.measured_.distances(asked_about) for model in (one, other))
    np.testing.assert_allclose(here, there, rtol=1e-3)
