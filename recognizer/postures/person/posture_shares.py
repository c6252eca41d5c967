"""Which posture does the hand of a person in view show? The windows around it say, without a mask.

A small network (`hand_net`) gives each posture, other hands and "no hand" a share; the shares are of the mean over
slightly moved, scaled and turned windows.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from recognizer.learning.database import IRRELEVANT
from recognizer.learning.decision import Decision
from recognizer.postures.hand.hand_frame import HandFrame
from recognizer.postures.person.hand_finder import Spot
from recognizer.postures.person.hand_net import HAND, SIDE, HandNet, look
from recognizer.postures.person.windows import cut_window
from recognizer.postures.types import Floats, Image

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
LEAST_SHARE = 0.5  # of the winner, below which there is no answer; 0.4 to 0.7 do nearly as well
NO_HAND = "no hand"
NOT_SHOWN = "a person is in view, but no raised hand stands out; show the hand beside the head, or come closer"
NO_HAND_SHARE = 0.5  # of "no hand", from which an object is none; no close-up of a real hand reaches it
PALM_RADIUS, KNUCKLE = 0.2, 0.2  # hand lengths: the palm's largest disc, and from its middle to the knuckle


@dataclass(frozen=True)
class Shares:
    """What the windows around one spot say; see :func:`shares`."""

    spot: Spot
    by_label: dict[str, float]


def known_labels() -> set[str]:
    """Return the postures that the network can name."""
    return {_label(name) for name in HandNet.load().classes} - {IRRELEVANT, NO_HAND}


def shares(bgr: Image, middle: Floats, hand: float, turn_rad: float = 0.0) -> dict[str, float]:
    """Return the share of each posture, of other hands and of no hand at one place, summing to 1.

    Args:
        bgr: (h, w, 3) uint8 photo.
        middle: (2,) x, y of the middle finger's knuckle, pixels.
        hand: length of the hand, wrist to fingertips, pixels.
        turn_rad: the windows are turned by so much, beyond what is asked anyway.
    """
    net = HandNet.load()
    looks = []
    for right, down, size, turned in ASKED:
        place = middle + np.array([right, down]) * hand
        looks.append(look(cut_window(bgr, place, hand * size, HAND, SIDE, turn_rad + turned)))
    by_label: dict[str, float] = {}
    for name, share in zip(net.classes, _softmax(net(np.stack(looks)).mean(axis=0)), strict=True):
        by_label[_label(name)] = by_label.get(_label(name), 0.0) + float(share)
    return by_label


def look_at(bgr: Image, spots: Sequence[Spot]) -> list[Shares]:
    """Return what is at some spots of a photo, the one that is most surely a hand first."""
    found = [Shares(spot, shares(bgr, spot.middle, spot.hand)) for spot in spots]
    return sorted(found, key=lambda here: here.by_label[NO_HAND])


def of_object(bgr: Image, frame: HandFrame) -> dict[str, float]:
    """Return :func:`shares` at the hand that an object would be, by its palm and where its fingers point."""
    hand = frame.radius / PALM_RADIUS
    up = np.array([np.sin(frame.up_rad), -np.cos(frame.up_rad)])
    return shares(bgr, frame.centre + KNUCKLE * hand * up, hand, -frame.up_rad)


def contradiction(bgr: Image, frame: HandFrame, label: str, in_doubt: bool) -> str:
    """Say why an object divided from its surroundings does not show the posture that its outline says; "" if it may.

    A face or a whole person is no hand, whatever its outline. Where it is in doubt that the object is a hand at all,
    the network has to see the same posture, if it knows it.

    Args:
        bgr: (h, w, 3) the picture that the object was found in.
        frame: its palm, and where its fingers point.
        label: what the outline says.
        in_doubt: a person may be in view, or the object is small in the picture.
    """
    seen = of_object(bgr, frame)
    winner = max(seen, key=lambda name: seen[name])
    if seen[NO_HAND] >= NO_HAND_SHARE:
        return f"something with the outline of {label}, but by what is inside it no hand"
    if in_doubt and label in known_labels() and winner != label:
        return f"something with the outline of {label}, but not by what is inside it; come closer"
    return ""


def decide(found: Shares, among: set[str] | None = None) -> Decision:
    """Name the posture, or reject it: other hand, no hand, or in doubt.

    The distance is what the likeliest posture's share lacks to 1.

    Args:
        found: shares of one spot.
        among: labels that the context allows; all when None.
    """
    allowed = {k: v for k, v in found.by_label.items() if among is None or k in among or k in (IRRELEVANT, NO_HAND)}
    total = max(sum(allowed.values()), 1e-12)
    votes = {label: share / total for label, share in allowed.items()}
    winner = max(votes, key=lambda label: votes[label])
    none = winner in (IRRELEVANT, NO_HAND)
    distance = 1 - max((share for label, share in votes.items() if label not in (IRRELEVANT, NO_HAND)), default=0.0)
    rejected = none or distance > 1 - LEAST_SHARE
    reason = ""
    if winner == NO_HAND:
        reason = NOT_SHOWN
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
    return bool(decision.votes) and max(decision.votes, key=lambda label: decision.votes[label]) == NO_HAND


def _label(name: str) -> str:
    return IRRELEVANT if name.startswith(IRRELEVANT) else name


def _softmax(scores: Floats) -> Floats:
    raised = np.exp(scores - scores.max())
    return np.asarray(raised / raised.sum())
