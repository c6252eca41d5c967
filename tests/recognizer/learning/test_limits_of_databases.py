"""Rejection must hold for persons nobody knows, with few clips and with many: parts of the shipped database."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.resources import resource
from recognizer.learning.body_model import BodyModel
from recognizer.learning.database import IRRELEVANT, Database


@pytest.fixture(scope="module")
def shipped() -> Database:
    return Database.load(resource("assets", "databases", "dynamic.parquet"))


def some(database: Database, persons: slice, irrelevant: int) -> Database:
    """All gestures of some persons, and so many irrelevant motions of each."""
    rows = []
    for person in np.unique(database.persons)[persons]:
        own = database.persons == person
        rows += np.flatnonzero(own & (database.labels != IRRELEVANT)).tolist()
        rows += np.flatnonzero(own & (database.labels == IRRELEVANT))[:irrelevant].tolist()
    return database.take(np.array(rows))


@pytest.mark.parametrize(("persons", "irrelevant", "least"), [(6, 10, 0.4), (24, 66, 0.8)], ids=["few", "many"])
def test_irrelevant_motion_of_unseen_persons_is_rejected(
    shipped: Database, monkeypatch: pytest.MonkeyPatch, persons: int, irrelevant: int, least: float
) -> None:
    monkeypatch.setattr("recognizer.learning.body_model.MANY", 3000)  # that the second is weighed with the network
    model = BodyModel().fit(some(shipped, slice(0, persons), irrelevant))
    assert (model.weights_.network is not None) == (persons == 24)
    unseen = some(shipped, slice(30, 36), 66)
    said = np.array([model.decide(vector).rejected for vector in unseen.features])
    gesture = unseen.labels != IRRELEVANT
    assert said[gesture].mean() < 0.1
    assert said[~gesture].mean() > least


def test_without_irrelevant_motion_what_is_far_from_every_gesture_is_rejected(shipped: Database) -> None:
    persons = np.unique(shipped.persons)
    known = np.isin(shipped.labels, ("yes", "no", "bye_right", "bye_left"))
    model = BodyModel().fit(shipped.take(known & np.isin(shipped.persons, persons[:12])))
    unseen = np.isin(shipped.persons, persons[30:36])
    gestures, others = (
        [model.decide(vector) for vector in shipped.features[unseen & rows]] for rows in (known, ~known)
    )
    assert np.mean([said.rejected for said in gestures]) < 0.1
    assert np.mean([said.rejected for said in others]) > 0.5
    assert all(said.rejected == (said.distance > said.threshold) for said in [*gestures, *others])
