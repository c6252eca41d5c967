"""How well postures are named: on unknown persons, and on photos a database has never seen."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass

import numpy as np
from sklearn.model_selection import GroupKFold

from recognizer.evaluation.cross_validation import KS, Evaluation, folds
from recognizer.evaluation.dataset import Entry
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.postures.errors import PhotoError
from recognizer.postures.learning.methods import method_of
from recognizer.postures.photo_recognizer import PhotoRecognizer

GROUPS = 10  # of persons: leaving out one person of a hundred at a time would learn a hundred models


@dataclass(frozen=True)
class Score:
    """Truth and answers, photo by photo; IRRELEVANT stands for "none of these" on both sides.

    Attributes:
        truth: (n,) str labels.
        answer: (n,) str labels, rejections included.
        nearest: (n,) str best guesses, as if nothing beyond the threshold were rejected.
    """

    truth: np.ndarray
    answer: np.ndarray
    nearest: np.ndarray

    @property
    def accuracy(self) -> float:
        """Share of the postures (not the irrelevant hands) that got the right answer."""
        known = self.truth != IRRELEVANT
        return float((self.answer == self.truth)[known].mean())

    @property
    def accuracy_without_threshold(self) -> float:
        """The same for the best guess."""
        known = self.truth != IRRELEVANT
        return float((self.nearest == self.truth)[known].mean())

    @property
    def rejected(self) -> float:
        """Share of the irrelevant hands that were rejected; NaN when there are none."""
        other = self.truth == IRRELEVANT
        return float((self.answer == IRRELEVANT)[other].mean()) if other.any() else float("nan")

    def confusion(self) -> tuple[list[str], np.ndarray]:
        """Return the labels and the counts, rows truth, columns answer."""
        labels = sorted({*self.truth, *self.answer})
        index = {label: i for i, label in enumerate(labels)}
        counts = np.zeros((len(labels), len(labels)), int)
        for truth, answer in zip(self.truth, self.answer, strict=True):
            counts[index[truth], index[answer]] += 1
        return labels, counts


def evaluate(
    database: Database, protocol: str = "loo-person", progress: Callable[[int, int], None] | None = None
) -> Evaluation:
    """Answer every photo of a database by a model that was not shown it, for tables and figures.

    Args:
        database: of postures, by either method. Photos in which no hand was found are not in it.
        protocol: "loo-person" (no person in both parts; more than 10 persons are left out in 10 groups) or "k-fold".
        progress: called with folds done and their number.

    Raises:
        DatabaseError: unknown protocol, or too few persons or photos for it.
    """
    n = len(database)
    nearest, rejected = np.full(n, IRRELEVANT, dtype=object), np.zeros(n, bool)
    right = {k: np.zeros(n, bool) for k in KS}
    splits = list(_splits(database, protocol))
    for number, (train, test) in enumerate(splits, 1):
        model = method_of(database).model().fit(database.take(train))
        for row in test:
            vector = database.features[row].astype(float)
            decision = model.decide(vector)
            nearest[row], rejected[row] = decision.nearest or IRRELEVANT, decision.rejected
            for k in KS:
                right[k][row] = model.decide(vector, k=k).nearest == database.labels[row]
        if progress is not None:
            progress(number, len(splits))
    known = database.labels != IRRELEVANT
    return Evaluation(
        method=database.method,
        protocol=protocol,
        labels=database.labels,
        families=database.families,
        nearest=nearest.astype(str),
        routed=database.families,
        rejected=rejected,
        persons=database.persons,
        sources=database.sources,
        actions=database.actions,
        by_k={k: float(np.mean(right[k][known])) for k in KS},
    )


def _splits(database: Database, protocol: str) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    persons = len(np.unique(database.persons))
    if protocol == "loo-person" and persons > GROUPS:
        yield from GroupKFold(GROUPS).split(database.features, database.labels, database.persons)
    else:
        yield from folds(database, protocol)


def on_unknown_persons(database: Database) -> Score:
    """Return the score of a database on itself, every person answered by others alone."""
    found = evaluate(database)
    return Score(found.labels.astype(str), np.where(found.rejected, IRRELEVANT, found.nearest), found.nearest)


def on_photos(
    recognizer: PhotoRecognizer, entries: Sequence[Entry], progress: Callable[[int, int], None] | None = None
) -> Score:
    """Return the score of a recogniser on photos, whole chain included; an unreadable photo counts as rejected."""
    answers, guesses = [], []
    for number, entry in enumerate(entries, 1):
        try:
            found = recognizer.recognize(entry.path)
            answers.append(found.label or IRRELEVANT)
            guesses.append(found.nearest or IRRELEVANT)
        except PhotoError:
            answers.append(IRRELEVANT)
            guesses.append(IRRELEVANT)
        if progress is not None:
            progress(number, len(entries))
    return Score(np.array([entry.label for entry in entries]), np.array(answers), np.array(guesses))
