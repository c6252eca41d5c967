"""A coefficient of agreement, or the words that stand where there is none."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Measure:
    """A coefficient.

    Attributes:
        name: which, with its weights or level.
        value: the number; None where it is not defined.
        words: the number as printed, or why there is none.
    """

    name: str
    value: float | None
    words: str

    @classmethod
    def of(cls, name: str, value: float) -> Measure:
        """Return a coefficient that is defined."""
        return cls(name, value, f"{value:.2f}")

    @classmethod
    def undefined(cls, name: str, agree: int, of: int) -> Measure:
        """Return a coefficient that is not defined since all ratings are equal, or there are none."""
        words = f"not defined: {agree} of {of} agree" if of else "not defined: nothing was rated twice"
        return cls(name, None, words)
