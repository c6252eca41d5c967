"""The motions people perform, read from ``assets/people/motions.toml`` and ``hands.toml``."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from nao_sim.people.actors.figure import skeleton
from nao_sim.people.actors.persons import FINGERS
from nao_sim.people.arrays import Array
from nao_sim.resources import resource

IRRELEVANT = "irrelevant"
SLIDES = ("root_x", "root_y", "root_z")
# Angles that change sign when left and right are exchanged: turns about the vertical and the forward axis.
_TRUNK = ("root", "waist", "chest", "head")
_ODD = ("root_y", *(f"{body}_{turn}" for body in _TRUNK for turn in ("roll", "yaw")))
_FINGER = {"thumb": ("abduct", "oppose", "roll", "mcp", "ip")} | dict.fromkeys(FINGERS, ("spread", "mcp", "pip", "dip"))


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
        underway: share of performances that begin and end amid the repeated step.
        vary: ranges that :func:`drawn_offsets` draws from once a performance, for every pose but rest.
    """

    label: str
    action: str
    steps: tuple[Mapping[str, Any], ...]
    start: tuple[str, ...]
    mirrored: bool
    either_side: bool
    reach: float
    weight: float
    underway: float
    vary: Mapping[str, Any]

    @property
    def repeated(self) -> int | None:
        """Number of the step that goes to and fro, from 0; None where nothing does."""
        steps = enumerate(self.steps)
        return next((k for k, step in steps if {"cycle", "about", "wander"} & step.keys()), None)


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
        posture = hand_postures()[value] if key.endswith("_hand") else {}
        said = {key[:2] + joint: amount for joint, amount in posture.items()} or {key: value}
        for joint, amount in said.items():
            for k, sign in _turned(joint, mirrored):
                angles[k] = sign * in_units(joint, amount)
                named[k] = True
    return Pose(angles, named)


def drawn_offsets(ranges: Mapping[str, Any], mirrored: bool, rng: Generator) -> Array:
    """Angles (nq,) drawn evenly from ``ranges``, joint -> (low, high) in the units of the motion file.

    ``b_`` before a joint turns both sides alike, ``x_`` turns the left against the right.
    """
    angles = np.zeros(len(joints()))
    for key, (low, high) in ranges.items():
        amount = in_units(key, rng.uniform(low, high))
        for k, sign in _turned(key, mirrored):
            angles[k] += sign * amount
    return angles


def in_units(joint: str, amount: float) -> float:
    """An amount of the motion file as joint position: slides stay statures, degrees become rad."""
    return float(amount if joint in SLIDES else np.radians(amount))


def _turned(key: str, mirrored: bool) -> list[tuple[int, float]]:
    """The joints of a key of the motion file, as (index in qpos, sign)."""
    side, stem = key[:2], key[2:]
    if side in ("b_", "x_"):
        against = -1.0 if side == "x_" else 1.0
        right, left = (against, 1.0) if mirrored else (1.0, against)
        return [(joints()["r_" + stem], right), (joints()["l_" + stem], left)]
    if side not in ("r_", "l_"):
        return [(joints()[key], -1.0 if mirrored and key in _ODD else 1.0)]
    if mirrored:
        side = "l_" if side == "r_" else "r_"
    return [(joints()[side + stem], 1.0)]


@lru_cache
def of_a_finger() -> NDArray[np.bool_]:
    """Joints (nq,) of fingers and thumbs: a hand's posture is not made larger."""
    return np.array([any(finger in name for finger in ("thumb", *FINGERS)) for name in joints()])


@lru_cache
def of_a_limb() -> NDArray[np.bool_]:
    """Joints (nq,) of arms and legs: a pose names their angle, while trunk and head move from where they are."""
    return np.array([name[:2] in ("r_", "l_") for name in joints()])


@lru_cache
def motions() -> dict[str, tuple[Motion, ...]]:
    """Label -> the ways it is performed; mirrored motions are resolved."""
    rows = tables()["motion"]
    own = [_motion(row, row["label"], mirrored=row.get("mirrored", False)) for row in rows if "steps" in row]
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
        underway=float(row.get("underway", tables()["underway"]["share"])),
        vary=row.get("vary", {}),
    )
