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
        rows: ``(angle of given, least of limits, greatest of limits)`` in rad, by rising first column.
    """

    given: str
    limits: str
    rows: tuple[tuple[float, float, float], ...]

    def range_at(self, angle: float) -> tuple[float, float]:
        """Return the limits in rad of the second joint for an angle in rad of the first."""
        rows = self.rows
        k = bisect_right(rows, angle, key=_first)
        if k == 0:
            return rows[0][1:]
        if k == len(rows):
            return rows[-1][1:]
        (x0, low0, high0), (x1, low1, high1) = rows[k - 1], rows[k]
        s = (angle - x0) / (x1 - x0)
        return low0 + s * (low1 - low0), high0 + s * (high1 - high0)


def _first(row: tuple[float, float, float]) -> float:
    return row[0]


@lru_cache
def pair_tables() -> tuple[PairTable, ...]:
    """Return the tables of ``assets/nao/anti_collision.toml``."""
    data = tomllib.loads(resource("assets", "nao", "anti_collision.toml").read_text("utf-8"))
    tables = []
    for row in data["table"]:
        rows = tuple((float(x), float(low), float(high)) for x, low, high in np.radians(row["rows_deg"]))
        tables.append(PairTable(row["given"], row["limits"], rows))
    return tuple(tables)


@lru_cache
def _indexed() -> tuple[tuple[int, int, PairTable], ...]:
    return tuple((ACTUATED.index(t.given), ACTUATED.index(t.limits), t) for t in pair_tables())


def clamp_pairs(angles: np.ndarray) -> np.ndarray:
    """Return ``(25,)`` angles with head pitch and ankle rolls inside what head yaw and ankle pitches leave them."""
    safe = np.array(angles, dtype=float)
    for given, limited, table in _indexed():
        low, high = table.range_at(safe[given])
        safe[limited] = min(max(safe[limited], low), high)
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
        low, high = table.range_at(proposed[given])
        if low <= proposed[limited] <= high:
            continue
        start, reach = previous[limited], step[limited]
        wanted = min(max(goal[limited], low), high)
        moved = min(max(wanted, start - reach), start + reach)
        if not low <= moved <= high:
            proposed[given] = previous[given]
            low, high = table.range_at(previous[given])
            moved = min(max(moved, low), high)
        proposed[limited] = moved
