"""Databases of postures: from the model hand, or from a folder of labelled photos."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from recognizer.errors import DatabaseError
from recognizer.evaluation.dataset import Entry
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.postures.errors import PhotoError
from recognizer.postures.hand import descriptors
from recognizer.postures.hand.hand_frame import hand_frames
from recognizer.postures.learning.methods import METHODS, nearest_upright
from recognizer.postures.learning.posture_model import PostureModel
from recognizer.postures.model_hand.silhouettes import silhouette
from recognizer.postures.model_hand.skeleton import Build, postures
from recognizer.postures.photo import read_photo
from recognizer.postures.types import Floats

Row = tuple[Floats, str, str, str, str]  # vector, label, action, person, source


def learn_from_model_hand(persons: int = 160, takes: int = 2, seed: int = 1) -> Database:
    """Return a database made of silhouettes of the model hand only: nobody's photo is in it.

    Args:
        persons: how many builds are drawn.
        takes: of each posture by each person; irrelevant hands get one.
        seed: of everything drawn.
    """
    rng = np.random.default_rng(seed)
    rows: list[Row] = []
    for number in range(persons):
        build = Build.draw(rng)
        for posture in postures():
            action = posture.action or posture.label
            for take in range(1 if posture.label == IRRELEVANT else takes):
                mask = silhouette(posture, build, rng)
                source = f"model hand {number}, {action}, take {take}"
                vector = descriptors.describe(mask, nearest_upright(hand_frames(mask)))
                rows.append((vector, posture.label, action, f"model{number:03d}", source))
    made = {"from": "silhouettes of the model hand", "persons": persons, "takes": takes, "seed": seed}
    return PostureModel().fit(_database(rows, descriptors.METHOD, made)).trained()


def learn_from_photos(
    entries: Sequence[Entry], method: str = descriptors.METHOD, progress: Callable[[int, int], None] | None = None
) -> Database:
    """Return a database made of labelled photos; those without a visible hand are named in its provenance.

    Args:
        entries: see `recognizer.evaluation.dataset.read_manifest`.
        method: "static" (ours) or "thesis_static" (the seven numbers of eq. 6).
        progress: called with photos done and photos in all.

    Raises:
        DatabaseError: an unknown method, or no photo shows a hand.
    """
    if method not in METHODS:
        raise DatabaseError(f"unknown method '{method}' for photos; known: {', '.join(METHODS)}")
    rows: list[Row] = []
    unused: list[str] = []
    for number, entry in enumerate(entries, 1):
        try:
            vector = METHODS[method].vector(read_photo(entry.path))
            rows.append((vector, entry.label, entry.action, entry.person, entry.name))
        except PhotoError:
            unused.append(entry.name)
        if progress is not None:
            progress(number, len(entries))
    if not rows:
        raise DatabaseError("no photo of the data set shows a hand; use photos with skin before a plain background")
    made = {"from": "photos", "photos": len(rows), "without_a_hand": unused}
    database = _database(rows, method, made)
    return METHODS[method].model().fit(database).trained()


def _database(rows: list[Row], method: str, made: dict[str, Any]) -> Database:
    vectors, labels, actions, persons, sources = zip(*rows, strict=True)
    relevant = [label if label == IRRELEVANT else "static" for label in labels]
    return Database(
        features=np.array(vectors, np.float32),
        labels=np.array(labels),
        families=np.array(relevant),
        actions=np.array(actions),
        persons=np.array(persons),
        sources=np.array(sources),
        names=METHODS[method].names,
        method=method,
        version=METHODS[method].version,
        provenance=made,
    )
