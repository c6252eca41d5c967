"""When an action counts as related to its target (thesis, appendix 4 (1-4-2)), by the rule of the session."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.session.session import Scoring
from nao_sim.gestures import library, vocabulary


@dataclass(frozen=True)
class Proposal:
    """The automatic score of one turn; a person confirms it or scores otherwise.

    Attributes:
        score: 0 or 1, or 0 to 2 on that scale.
        side: ``same``, ``mirrored`` or ``other``; None: the gesture has no side, or nothing known was seen.
    """

    score: int
    side: str | None


def propose(target: str, seen: str | None, scoring: Scoring) -> Proposal:
    """Score what was seen.

    On the scale 0/1/2 a related action is 2, and 1 ("emerging") is what is not related by the rule but the target on
    the other side, or of its family.

    Args:
        target: the gesture asked for.
        seen: the label recognised; None: nothing, or nothing known.
        scoring: the rule and scale.
    """
    related = seen is not None and _related(target, seen, scoring)
    full = 2 if scoring.scale == "0/1/2" else 1
    score = full if related else 0
    if not related and full == 2 and seen is not None:
        score = int(seen == _twin(target) or _family(seen) == _family(target))
    return Proposal(score, side_against(target, seen))


def _related(target: str, seen: str, scoring: Scoring) -> bool:
    if scoring.rule == "same_class":
        return seen in (target, _twin(target))
    if scoring.rule == "same_side":
        return seen == target
    if scoring.rule == "same_family":
        return _family(seen) == _family(target) and side_of(seen) == side_of(target)
    return seen in scoring.related.get(target, ())


def side_against(target: str, seen: str | None) -> str | None:
    """Return whether the imitator used the model's own side, the other one, or another part of the body."""
    asked = side_of(target)
    if seen is None or asked is None:
        return None
    shown = side_of(seen)
    if shown not in ("left", "right") or asked not in ("left", "right"):
        return "same" if shown == asked else "other"
    return "same" if shown == asked else "mirrored"


def side_of(gesture: str) -> str | None:
    """Return ``left`` or ``right``, ``both``, or None for a gesture of head or trunk and for hand postures."""
    if _twin(gesture) == gesture:
        return "both" if "two_hands" in gesture else None
    return "left" if "left" in gesture.split("_") else "right"


def _twin(gesture: str) -> str:
    known = vocabulary()
    return known[gesture].mirror if gesture in known else library()[gesture].mirror


def _family(gesture: str) -> str:
    known = vocabulary()
    return known[gesture].family if gesture in known else library()[gesture].family
