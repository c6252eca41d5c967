"""How well does a database recognise persons it has never seen? (thesis app. 6; S19)"""

from __future__ import annotations

import dataclasses
from collections.abc import Callable, Iterator
from typing import Any

import joblib
import numpy as np
from sklearn.model_selection import LeaveOneGroupOut, StratifiedKFold

from recognizer.errors import DatabaseError
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.methods import method_of

PROTOCOLS = ("loo-person", "k-fold")
KS = (1, 3, 5, 7, 9)


@dataclasses.dataclass(frozen=True)
class Evaluation:
    """Every clip of a database, answered by a model that was not shown it (nor, by loo-person, its person).

    Attributes:
        method, protocol: what was evaluated, and how.
        labels: (n,) true labels, "irrelevant" among them.
        families: (n,) true families.
        nearest: (n,) best gesture, rejected or not.
        routed: (n,) family it was taken for, small or large.
        rejected: (n,) bool.
        persons, sources, actions: (n,) of each clip.
        by_k: k -> share of gestures named rightly when k neighbours vote.
    """

    method: str
    protocol: str
    labels: np.ndarray
    families: np.ndarray
    nearest: np.ndarray
    routed: np.ndarray
    rejected: np.ndarray
    persons: np.ndarray
    sources: np.ndarray
    actions: np.ndarray
    by_k: dict[int, float]

    @property
    def gestures(self) -> np.ndarray:
        """(n,) bool: clips of the vocabulary."""
        return self.labels != IRRELEVANT

    def score(self, mask: np.ndarray | None = None) -> float:
        """Share of the gestures (among ``mask``) that are named rightly, before rejection; NaN for none."""
        chosen = self.gestures if mask is None else self.gestures & mask
        return float(np.mean(self.nearest[chosen] == self.labels[chosen])) if chosen.any() else float("nan")

    def summary(self) -> dict[str, float]:
        """The rows of the table of results, as shares."""
        known = self.gestures
        if "static" in self.families:
            out = {label: self.score(self.labels == label) for label in sorted(set(self.labels[known].tolist()))}
            out = {"all postures": self.score()} | out
        else:
            out = {f"{family} amplitude": self.score(self.families == family) for family in ("small", "large")}
            out |= {label: self.score(self.labels == label) for label in ("yes", "no")}
            out["routing"] = float(np.mean(self.routed[known] == self.families[known]))
        out["false rejection"] = float(np.mean(self.rejected[known]))
        if (~known).any():
            out["irrelevant rejected"] = float(np.mean(self.rejected[~known]))
        return out

    def rejections(self) -> dict[str, tuple[int, float, str]]:
        """For each action: its clips, the share rejected, and what those not rejected are mostly taken for.

        Most clips not rejected first; "" where all are rejected.
        """
        out = {}
        for action in np.unique(self.actions).tolist():
            clips = self.actions == action
            taken_for, counts = np.unique(self.nearest[clips & ~self.rejected], return_counts=True)
            mostly = str(taken_for[np.argmax(counts)]) if len(counts) else ""
            out[action] = (int(clips.sum()), float(self.rejected[clips].mean()), mostly)
        return dict(sorted(out.items(), key=lambda item: -item[1][0] * (1 - item[1][1])))

    def confusion(self, family: str) -> tuple[list[str], np.ndarray]:
        """Return the labels of a family and the counts, rows true, columns answered (others in the last)."""
        labels = sorted(set(self.labels[self.families == family].tolist()))
        counts = np.zeros((len(labels), len(labels) + 1), int)
        for true, answer in zip(self.labels, self.nearest, strict=True):
            if true in labels:
                counts[labels.index(true), labels.index(answer) if answer in labels else len(labels)] += 1
        return labels, counts


def folds(database: Database, protocol: str, k: int = 10) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Yield row indices of training and test for each fold.

    Raises:
        DatabaseError: unknown protocol, or too few persons or clips for it.
    """
    if protocol == "loo-person":
        if len(np.unique(database.persons)) < 2:
            raise DatabaseError("leave-one-person-out needs clips of two persons at least; film or import more")
        yield from LeaveOneGroupOut().split(database.features, database.labels, database.persons)
    elif protocol == "k-fold":
        fewest = int(np.unique(database.labels, return_counts=True)[1].min())
        if fewest < 2:
            raise DatabaseError("k-fold needs two clips of every gesture at least; film or import more")
        splitter = StratifiedKFold(min(k, fewest), shuffle=True, random_state=0)
        yield from splitter.split(database.features, database.labels)
    else:
        raise DatabaseError(f"unknown protocol '{protocol}'; choose {' or '.join(PROTOCOLS)}")


def evaluate(
    database: Database,
    protocol: str = "loo-person",
    progress: Callable[[int, int], None] | None = None,
    jobs: int = 1,
) -> Evaluation:
    """Answer every clip by a model learned from the other folds, limits and thresholds included.

    Args:
        database: rows of one method.
        protocol: one of PROTOCOLS.
        progress: called with how many folds are done, and of how many.
        jobs: processes; how many makes no difference to the answers.
    """
    model_class: Any = method_of(database).model
    n = len(database)
    nearest, routed = np.full(n, IRRELEVANT, dtype=object), np.full(n, "small", dtype=object)
    rejected = np.zeros(n, bool)
    right = np.zeros((n, len(KS)), bool)
    splits = list(folds(database, protocol))
    learn = model_class.learner(database)
    todo = (joblib.delayed(_fold)(learn, database, train, test) for train, test in splits)
    done = joblib.Parallel(min(jobs, len(splits)), return_as="generator")(todo)
    for number, ((_, test), decisions) in enumerate(zip(splits, done, strict=True), 1):
        nearest[test], routed[test], rejected[test], right[test] = decisions
        if progress is not None:
            progress(number, len(splits))
    known = database.labels != IRRELEVANT
    return Evaluation(
        database.method,
        protocol,
        database.labels,
        database.families,
        nearest.astype(str),
        routed.astype(str),
        rejected,
        database.persons,
        database.sources,
        database.actions,
        {k: float(np.mean(right[known, column])) for column, k in enumerate(KS)},
    )


def _fold(
    learn: Callable[[np.ndarray], Any], database: Database, train: np.ndarray, test: np.ndarray
) -> tuple[list[str], list[str], list[bool], np.ndarray]:
    """What a model of the rows ``train`` says of the rows ``test``: gesture, family, rejected, right with each k."""
    model = learn(train)
    vectors = database.features[test]
    decisions = [model.decide(vector) for vector in vectors]
    right = np.zeros((len(test), len(KS)), bool)
    for row in np.flatnonzero(database.labels[test] != IRRELEVANT):
        right[row] = [model.decide(vectors[row], k=k).nearest == database.labels[test[row]] for k in KS]
    return [d.nearest for d in decisions], [d.family for d in decisions], [d.rejected for d in decisions], right
