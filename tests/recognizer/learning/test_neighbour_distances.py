"""Rows in a metric: distances worked out again the long way."""

from __future__ import annotations

import numpy as np
import pytest

from recognizer.learning.database import IRRELEVANT, Rows
from recognizer.learning.neighbour_distances import MeasuredRows, Metric

K = 3


def measured(counts: dict[tuple[str, str], int], seed: int = 0) -> tuple[MeasuredRows, np.ndarray]:
    """Rows of (label, action) -> how many, shuffled, and their features in the order of ``rows``."""
    rng = np.random.default_rng(seed)
    kinds = [kind for kind, count in counts.items() for _ in range(count)]
    kinds = [kinds[i] for i in rng.permutation(len(kinds))]
    labels, actions = (np.array(column) for column in zip(*kinds, strict=True))
    features = rng.normal(size=(len(labels), 7)).astype(np.float32)
    sources = np.array([str(i) for i in range(len(labels))])
    metric = Metric(rng.normal(size=7), rng.uniform(0.5, 2, 7), rng.normal(size=(7, 4)))
    rows = MeasuredRows(metric, Rows(labels, labels, actions, labels, sources), features, mirror=False)
    return rows, features[rows.rows.sources.astype(int)]


KINDS = {"clap": 2, "beckon": 20, "phone": 5}
COUNTS = {("stop", "stop"): 12, ("yes", "yes"): 1, **{(IRRELEVANT, kind): n for kind, n in KINDS.items()}}


def test_class_distances_the_long_way() -> None:
    rows, features = measured(COUNTS)
    metric = rows.metric
    vectors = np.random.default_rng(1).normal(size=(4, 7)).astype(np.float32)
    found = rows.class_distances(rows.distances(vectors), K)
    for vector, out in zip(vectors, found, strict=True):
        within = np.clip(vector, features.min(axis=0), features.max(axis=0))
        away = np.linalg.norm((within - features) / metric.scale @ metric.components, axis=1)
        expected = []
        for count in (K, 3 * K):
            expected += [np.sort(away[rows.rows.labels == label])[:count].mean() for label in rows.labels]
        expected += [np.sort(away[rows.rows.actions == kind])[:K].mean() for kind in ("beckon", "clap", "phone")]
        np.testing.assert_allclose(out, expected, rtol=1e-4)
        irrelevant = rows.rows.labels == IRRELEVANT
        assert (
            rows.nearest_kind(rows.distances(vector[None])[0])
            == rows.rows.actions[np.argmin(np.where(irrelevant, away, np.inf))]
        )


def test_one_feature_leads_no_further_than_the_rows_do() -> None:
    rows, features = measured(COUNTS)
    inside = features[:1].copy()
    inside[0, 3] = features[:, 3].max()
    far = inside.copy()
    far[0, 3] = 1e6
    np.testing.assert_array_equal(rows.distances(far), rows.distances(inside))
    assert not np.allclose(rows.distances(far), rows.distances(features[:1]))


def test_without_irrelevant_motion_there_are_no_kinds() -> None:
    rows, features = measured({("stop", "stop"): 4, ("yes", "yes"): 4})
    assert rows.class_distances(rows.distances(features), K).shape == (8, 4)


def test_as_other_rows_see_it_what_is_missing_is_infinitely_far() -> None:
    whole, features = measured(COUNTS)
    part, _ = measured({kind: n for kind, n in COUNTS.items() if kind[1] not in ("clap", "yes")})
    seen = part.distances_as(whole, features[:2], K)
    labels = whole.labels.tolist()
    missing = [
        labels.index("yes"),
        len(labels) + labels.index("yes"),
        2 * len(labels) + whole.kinds.tolist().index("clap"),
    ]
    assert np.isinf(seen[:, missing]).all()
    assert np.isfinite(np.delete(seen, missing, axis=1)).all()
    own = part.class_distances(part.distances(features[:2]), K)
    assert np.delete(seen, missing, axis=1) == pytest.approx(own)
