"""Which posture does the hand of a person in view show? The windows around it say, without a mask.

A linear discriminant of `windows.fine_vector` gives each posture, other hands and "no hand" a share; the shares are
of the mean over slightly moved, scaled and turned windows.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from recognizer.database import IRRELEVANT
from recognizer.decision import Decision
from recognizer.static.hand_finder import Spot, weights
from recognizer.static.types import Floats, Image
from recognizer.static.windows import fine_vector

# The windows that are asked: moved right and down (hand lengths), scaled, turned (rad).
ASKED = (
    (0.0, 0.0, 1.0, 0.0),
    (0.0, 0.0, 0.88, 0.0),
    (0.0, 0.0, 1.13, 0.0),
    (0.0, 0.0, 1.0, -0.2),
    (0.0, 0.0, 1.0, 0.2),
    (0.07, 0.0, 1.0, 0.0),
    (-0.07, 0.0, 1.0, 0.0),
    (0.0, 0.07, 1.0, 0.0),
    (0.0, -0.07, 1.0, 0.0),
)
LEAST_SHARE = 0.6  # of the winner, below which there is no answer; chosen on odd-numbered persons
NO_HAND = "no hand"


@dataclass(frozen=True)
class Shares:
    """What the windows around one spot say."""

    spot: Spot
    by_label: dict[str, float]  # posture, "irrelevant" or "no hand" -> share, summing to 1


def known_labels() -> set[str]:
    """Return the postures that windows can name."""
    return {_label(name) for name in weights()["classes"]} - {IRRELEVANT, NO_HAND}


def shares(bgr: Image, spot: Spot) -> Shares:
    """Return the share of each posture, of other hands and of no hand, at one spot of a photo."""
    stored = weights()
    total = np.zeros(len(stored["classes"]))
    for right, down, size, turn_rad in ASKED:
        middle = spot.middle + np.array([right, down]) * spot.hand
        total += fine_vector(bgr, middle, spot.hand * size, turn_rad) @ stored["fine_weights"].astype(np.float32)
    by_label: dict[str, float] = {}
    for name, share in zip(stored["classes"], _softmax(total / len(ASKED) + stored["fine_offsets"]), strict=True):
        by_label[_label(name)] = by_label.get(_label(name), 0.0) + float(share)
    return Shares(spot, by_label)


def decide(found: Shares, among: set[str] | None = None) -> Decision:
    """Name the posture, or reject it: other hand, no hand, or in doubt.

    Args:
        found: shares of one spot.
        among: labels that the context allows; all when None.
    """
    allowed = {k: v for k, v in found.by_label.items() if among is None or k in among or k in (IRRELEVANT, NO_HAND)}
    total = max(sum(allowed.values()), 1e-12)
    votes = {label: share / total for label, share in allowed.items()}
    winner = max(votes, key=lambda label: votes[label])
    distance = 1 - votes[winner]
    none = winner in (IRRELEVANT, NO_HAND)
    rejected = none or distance > 1 - LEAST_SHARE
    reason = ""
    if winner == NO_HAND:
        reason = "a person is in view, but no raised hand stands out; show the hand beside the head, or come closer"
    elif none:
        reason = "the person in view shows a hand, but none of the postures"
    elif rejected:
        reason = f"the hand of the person in view is {winner} with {votes[winner]:.0%} only, below {LEAST_SHARE:.0%}"
    nearest = IRRELEVANT if none else winner
    label = None if rejected else winner
    family = IRRELEVANT if none else "static"
    return Decision(label, nearest, family, rejected, reason, distance, 1 - LEAST_SHARE, votes, ())


def no_hand(decision: Decision) -> bool:
    """Whether :func:`decide` found that nothing like a hand is there."""
    return max(decision.votes, key=lambda label: decision.votes[label]) == NO_HAND


def _label(name: str) -> str:
    return IRRELEVANT if str(name).startswith(IRRELEVANT) else str(name)


def _softmax(scores: Floats) -> Floats:
    raised = np.exp(scores - scores.max())
    return np.asarray(raised / raised.sum())
