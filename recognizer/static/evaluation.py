"""How well postures are named: on unknown persons, and on photos a database has never seen."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
from sklearn.model_selection import GroupKFold

from recognizer.database import IRRELEVANT, Database
from recognizer.dataset import Entry
from recognizer.static.errors import PhotoError
from recognizer.static.methods import method_of
from recognizer.static.recognise import PhotoRecognizer


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


def on_unknown_persons(database: Database, folds: int = 10) -> Score:
    """Return the score of a database on itself, every person answered by the others alone.

    Args:
        database: of postures.
        folds: groups of persons; at least as many persons are needed.
    """
    answer = np.full(len(database), IRRELEVANT, dtype=object)
    nearest = answer.copy()
    split = GroupKFold(folds).split(database.features, database.labels, database.persons)
    for train, test in split:
        model = method_of(database).model().fit(database.take(train))
        for row in test:
            decision = model.decide(database.features[row].astype(float))
            answer[row] = decision.label or IRRELEVANT
            nearest[row] = decision.nearest or IRRELEVANT
    return Score(database.labels.astype(str), answer.astype(str), nearest.astype(str))


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
