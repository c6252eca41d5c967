"""Latencies where some waits ended without an answer: those are at least so long, never a number."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass


@dataclass(frozen=True)
class LatencySummary:
    """Latencies of some turns.

    Attributes:
        answered: how many had a movement.
        censored: how many waits ended without one.
        median_s: the Kaplan-Meier median; None where fewer than half can be said to have answered.
        shortest_s, longest_s: range of the answered ones; None without any.
    """

    answered: int
    censored: int
    median_s: float | None
    shortest_s: float | None
    longest_s: float | None


def summarise_latency(answered_s: Sequence[float], censored_s: Sequence[float]) -> LatencySummary:
    """Summarise latencies.

    Args:
        answered_s: latencies of turns with a movement, in seconds.
        censored_s: how long was waited in the turns without.
    """
    survival, median = 1.0, None
    for time in sorted(set(answered_s)):
        at_risk = sum(t >= time for t in answered_s) + sum(t >= time for t in censored_s)
        survival *= 1 - sum(t == time for t in answered_s) / at_risk
        if survival <= 0.5 + 1e-12:
            median = time
            break
    return LatencySummary(
        len(answered_s), len(censored_s), median, min(answered_s, default=None), max(answered_s, default=None)
    )
