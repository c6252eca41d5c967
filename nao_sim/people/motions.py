"""The motions people perform, read from ``assets/people/motions.toml`` and ``hands.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nao_sim.people.figure import skeleton
from nao_sim.people.surface import Array
from nao_sim.resources import resource

IRRELEVANT = "irrelevant"
SLIDES = ("root_x", "root_y", "root_z")
# Angles that change sign when left and right are exchanged: turns about the vertical and the forward axis.
_TRUNK = ("root", "waist", "chest", "head")
_ODD = ("root_y", *(f"{body}_{turn}" for body in _TRUNK for turn in ("roll", "yaw")))
_FINGER = {"thumb": ("abduct", "oppose", "roll", "mcp", "ip")} | dict.fromkeys(
    ("index", "middle", "ring", "little"), ("spread", "mcp", "pip", "dip")
)


@dataclass(frozen=True)
class Motion:
    """One way of performing a label.

    Attributes:
        label: a vocabulary name or ``irrelevant``.
        action: what an irrelevant motion is; the label otherwise.
        steps: rows as in the file; pose names are keys of :func:`poses`.
        start: poses the motion may begin in.
        mirrored: exchange left and right of every pose.
        either_side: left and right are exchanged in half of the performances.
        reach: how much of the drawn size goes into poses that are not cycles.
        weight: how often it is drawn among its label's motions.
    """

    label: str
    action: str
    steps: tuple[Mapping[str, Any], ...]
    start: tuple[str, ...]
    mirrored: bool
    either_side: bool
    reach: float
    weight: float


@lru_cache
def tables() -> dict[str, Any]:
    """Return the raw tables of the motion file."""
    with resource("assets", "people", "motions.toml").open("rb") as file:
        return tomllib.load(file)


@lru_cache
def joints() -> dict[str, int]:
    """Joint name -> index in ``qpos`` of the person."""
    model = skeleton().compile()
    return {model.joint(k).name: k for k in range(model.njnt)}


@lru_cache
def joint_ranges() -> tuple[Array, Array]:
    """Lowest and highest angle (nq,) of every joint, rad; infinite where a joint has no limit."""
    model = skeleton().compile()
    limited = model.jnt_limited.astype(bool)
    low, high = model.jnt_range.T
    return np.where(limited, low, -np.inf), np.where(limited, high, np.inf)


@lru_cache
def hand_postures() -> dict[str, dict[str, float]]:
    """Posture name -> joint (without side) -> degrees."""
    with resource("assets", "people", "hands.toml").open("rb") as file:
        raw = tomllib.load(file)
    return {
        name: {
            f"{finger}_{joint}": float(angle)
            for finger, angles in fingers.items()
            for joint, angle in zip(_FINGER[finger], angles, strict=True)
        }
        for name, fingers in raw.items()
    }


@dataclass(frozen=True)
class Pose:
    """Angles (nq,) in rad (slides in statures), and which joints (nq,) the pose says anything about."""

    angles: Array
    named: NDArray[np.bool_]


@lru_cache
def pose(name: str, mirrored: bool = False) -> Pose:
    """Look up a pose of the motion file, or its mirror image."""
    angles, named = np.zeros(len(joints())), np.zeros(len(joints()), dtype=bool)
    for key, value in tables()["pose"][name].items():
        side = key[:2] if key[:2] in ("r_", "l_") else ""
        if mirrored and side:
            side = "l_" if side == "r_" else "r_"
        stem = key[2:] if side else key
        sign = -1.0 if mirrored and stem in _ODD else 1.0
        said = hand_postures()[value] if stem == "hand" else {stem: sign * value}
        for joint, amount in said.items():
            k = joints()[side + joint]
            angles[k] = amount if joint in SLIDES else np.radians(amount)
            named[k] = True
    return Pose(angles, named)


@lru_cache
def motions() -> dict[str, tuple[Motion, ...]]:
    """Label -> the ways it is performed; mirrored motions are resolved."""
    rows = tables()["motion"]
    own = [_motion(row, row["label"], mirrored=False) for row in rows if "steps" in row]
    for row in rows:
        if "mirror_of" in row:
            twins = [other for other in rows if other["label"] == row["mirror_of"]]
            own += [_motion(twin, row["label"], mirrored=True) for twin in twins]
    labels = dict.fromkeys(motion.label for motion in own)
    return {label: tuple(m for m in own if m.label == label) for label in labels}


def _motion(row: Mapping[str, Any], label: str, mirrored: bool) -> Motion:
    return Motion(
        label=label,
        action=row.get("action", label),
        steps=tuple(row["steps"]),
        start=tuple(row.get("from", ("rest",))),
        mirrored=mirrored,
        either_side=bool(row.get("either_side", False)),
        reach=float(row.get("reach", 0.25)),
        weight=float(row.get("weight", 1.0)),
    )
