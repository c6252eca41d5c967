"""NAOqi's anti-collision tables: how far one joint may go depends on another.

The head must not hit the shoulders, nor a foot its shin. The robot's own firmware clamps commands with these tables;
contacts alone would let a motor push against the shell.
"""

from __future__ import annotations

import tomllib
from bisect import bisect_right
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from nao_sim.resources import resource
from nao_sim.robot.joints import ACTUATED


@dataclass(frozen=True)
class PairTable:
    """Limits of one joint as a piecewise linear function of another.

    Attributes:
        given, limits: the joints' names.
        angles: angles of the first joint, rising, rad.
        least, greatest: limits of the second joint at those angles, rad.
    """

    given: str
    limits: str
    angles: tuple[float, ...]
    least: tuple[float, ...]
    greatest: tuple[float, ...]

    def range_at(self, angle: float) -> tuple[float, float]:
        """Return the limits in rad of the second joint for an angle in rad of the first."""
        angles, least, greatest = self.angles, self.least, self.greatest
        k = bisect_right(angles, angle)
        if k == 0:
            return least[0], greatest[0]
        if k == len(angles):
            return least[-1], greatest[-1]
        s = (angle - angles[k - 1]) / (angles[k] - angles[k - 1])
        return least[k - 1] + s * (least[k] - least[k - 1]), greatest[k - 1] + s * (greatest[k] - greatest[k - 1])


@lru_cache
def pair_tables() -> tuple[PairTable, ...]:
    """Return the tables of ``assets/nao/anti_collision.toml``."""
    data = tomllib.loads(resource("assets", "nao", "anti_collision.toml").read_text("utf-8"))
    return tuple(
        PairTable(row["given"], row["limits"], *(tuple(column) for column in np.radians(row["rows_deg"]).T.tolist()))
        for row in data["table"]
    )


@lru_cache
def _indexed() -> tuple[tuple[int, int, PairTable], ...]:
    return tuple((ACTUATED.index(t.given), ACTUATED.index(t.limits), t) for t in pair_tables())


def clamp_pairs(angles: np.ndarray) -> np.ndarray:
    """Return ``(25,)`` angles with head pitch and ankle rolls inside what head yaw and ankle pitches leave them."""
    safe = np.array(angles, dtype=float)
    for given, limited, table in _indexed():
        # item() gives a plain float, with which comparing is several times faster than with numpy's.
        low, high = table.range_at(safe.item(given))
        if not low <= safe.item(limited) <= high:
            safe[limited] = min(max(safe.item(limited), low), high)
    return safe


def hold_pairs(previous: np.ndarray, proposed: np.ndarray, goal: np.ndarray, step: np.ndarray) -> None:
    """Make a rate-limited step from a safe set-point end in a safe one, in place.

    The limited joint follows the edge of its table; where it is too slow for that, the other joint waits for it.

    Args:
        previous: ``(25,)`` safe set-point the step starts from.
        proposed: ``(25,)`` set-point one step later, rate-limited; changed in place.
        goal: ``(25,)`` where the set-point is heading.
        step: ``(25,)`` greatest change in this step, rad.
    """
    for given, limited, table in _indexed():
        low, high = table.range_at(proposed.item(given))
        if low <= proposed.item(limited) <= high:
            continue
        start, reach = previous[limited], step[limited]
        wanted = min(max(goal[limited], low), high)
        moved = min(max(wanted, start - reach), start + reach)
        if not low <= moved <= high:
            proposed[given] = previous[given]
            low, high = table.range_at(previous[given])
            moved = min(max(moved, low), high)
        proposed[limited] = moved
