"""From neighbours to an answer or a rejection."""

from __future__ import annotations

import dataclasses
import math

import numpy as np

from recognizer.learning.database import Database, Rows
from recognizer.learning.neighbour_classifier import votes_of

SHOWN = 5  # neighbours reported


@dataclasses.dataclass(frozen=True)
class Neighbour:
    """One row of the database near the clip."""

    label: str
    action: str
    person: str
    source: str
    distance: float


@dataclasses.dataclass(frozen=True)
class Decision:
    """What the neighbours say.

    Attributes:
        label: the gesture, None when rejected.
        nearest: the gesture that would be the answer, even when rejected; empty where nothing could be compared.
        family: family of ``nearest``.
        rejected: True when no gesture of the vocabulary was seen.
        reason: why it was rejected, empty otherwise.
        distance: what the threshold is compared with; small is sure. NaN where nothing could be compared.
        threshold: distance beyond which a gesture is rejected; NaN likewise.
        votes: label -> share of the votes.
        neighbours: nearest first.
    """

    label: str | None
    nearest: str
    family: str
    rejected: bool
    reason: str
    distance: float
    threshold: float
    votes: dict[str, float]
    neighbours: tuple[Neighbour, ...]

    @classmethod
    def without_comparison(cls, reason: str) -> Decision:
        """A rejection of a clip in which there was nothing to compare."""
        return cls(None, "", "", True, reason, math.nan, math.nan, {}, ())

    def rejected_for(self, reason: str) -> Decision:
        """The same, but rejected whatever the neighbours say."""
        return dataclasses.replace(self, label=None, rejected=True, reason=reason)


def decide(
    database: Database,
    rows: np.ndarray,
    distances: np.ndarray,
    k: int,
    threshold: float,
    vote: str = "majority",
    power: float = 1.0,
) -> Decision:
    """Vote among the nearest rows and reject what is too far.

    Args:
        database: where the rows are.
        rows: indices of the nearest rows, nearest first.
        distances: their distances, ascending.
        k: how many of them vote.
        threshold: largest distance that is answered.
        vote: "majority" or "distance".
        power: n of 1/dⁿ.
    """
    labels, targets = np.unique(database.labels[rows[:k]], return_inverse=True)
    votes = votes_of(distances[None, :k], targets[None], len(labels), vote, power)[0]
    shares = {str(label): float(v) for label, v in zip(labels, votes / votes.sum(), strict=True)}
    winner = str(labels[int(np.argmax(votes))])
    first = int(np.flatnonzero(database.labels[rows] == winner)[0])
    distance = float(distances[first])
    neighbours = tuple(
        neighbour(database, int(row), float(d)) for row, d in zip(rows[:SHOWN], distances[:SHOWN], strict=True)
    )
    far = distance > threshold
    reason = f"nearest is {winner} at distance {distance:.3g}, beyond {threshold:.3g}" if far else ""
    family = str(database.families[rows[first]])
    return Decision(None if far else winner, winner, family, far, reason, distance, threshold, shares, neighbours)


def neighbour(rows: Database | Rows, row: int, distance: float) -> Neighbour:
    """Describe one row of a database."""
    columns = (rows.labels, rows.actions, rows.persons, rows.sources)
    label, action, person, source = (str(column[row]) for column in columns)
    return Neighbour(label, action, person, source, distance)
