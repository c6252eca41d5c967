"""Aldebaran's official postures, from ``assets/nao/postures.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from types import MappingProxyType

import numpy as np

from nao_sim.resources import resource
from nao_sim.robot.errors import UnknownNameError
from nao_sim.robot.joints import BODY, joint_table


@dataclass(frozen=True)
class Posture:
    """A whole-body posture.

    Attributes:
        name: NAOqi's name.
        angles: ``(26,)`` float64 in ``BODY`` order, rad (hands: open fraction), read-only.
        torso: height in m and pitch in rad (positive = leaning forward) of the torso of a posture that does not
            stand on its soles; None for a standing one.
    """

    name: str
    angles: np.ndarray
    torso: tuple[float, float] | None

    def __getitem__(self, joint: str) -> float:
        return float(self.angles[joint_table().index(joint)])

    def clamped(self, limits: str = "thesis") -> np.ndarray:
        """Return the angles inside a limit set, ``(26,)``: three official knees pass table A1-1 by 0.3 degrees."""
        low, high = joint_table().range_rad(limits).T
        return np.clip(self.angles, low, high)


def _posture(name: str, row: dict[str, float]) -> Posture:
    angles = np.array([row[j] if j.endswith("Hand") else np.radians(row[j]) for j in BODY])
    angles.setflags(write=False)
    torso = (row["torso_height_m"], float(np.radians(row["torso_pitch_deg"]))) if "torso_height_m" in row else None
    return Posture(name, angles, torso)


@lru_cache
def postures() -> Mapping[str, Posture]:
    """Return the official postures by name."""
    rows = tomllib.loads(resource("assets", "nao", "postures.toml").read_text("utf-8"))
    return MappingProxyType({name: _posture(name, row) for name, row in rows.items()})


def posture(name: str) -> Posture:
    """Return one posture; raises :class:`UnknownNameError` with the nearest name."""
    try:
        return postures()[name]
    except KeyError:
        raise UnknownNameError("posture", name, postures()) from None
