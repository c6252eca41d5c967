"""Minimum-jerk strokes through one or more postures.

Flash & Hogan, *The coordination of arm movements*, J. Neurosci. 5 (1985), eq. 5: position 10 s³ - 15 s⁴ + 6 s⁵ of the
way at the share s of the time.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.interpolate import PchipInterpolator

from nao_sim.people.arrays import Array


@dataclass(frozen=True)
class Stroke:
    """A minimum-jerk course through ``knots`` (k, nq) from ``start`` for ``seconds``."""

    start: float
    seconds: float
    knots: Array


def course(strokes: Sequence[Stroke], times: Array) -> Array:
    """Angles (n, nq) at ``times`` (n,) in s of strokes in time order; held between them."""
    out = np.tile(strokes[0].knots[0], (len(times), 1))
    for stroke in strokes:
        now = times >= stroke.start
        share = np.clip((times[now] - stroke.start) / stroke.seconds, 0.0, 1.0)
        out[now] = _along(stroke.knots, minimum_jerk(share))
    return out


def minimum_jerk(share: Array) -> Array:
    """Share of the way covered at a share of the time, both in [0, 1]."""
    return share**3 * (10 - 15 * share + 6 * share**2)


def _along(knots: Array, way: Array) -> Array:
    """Angles (n, nq) at the shares ``way`` (n,) of the course through ``knots``."""
    if len(knots) == 2:
        return knots[0] + way[:, None] * (knots[1] - knots[0])
    return PchipInterpolator(np.linspace(0, 1, len(knots)), knots, axis=0)(way)
