"""A jointed model hand: bones of a person's proportions, flexed and spread into a posture, with its flesh.

It exists so that postures can be learnt from a description (`postures.toml`) and no photo of anybody. Lengths are in
palm widths; x to the thumb of a right hand seen from its palm, y along the forearm to the fingers, z out of the palm.
Proportions are rounded from common hand anthropometry (palm width 84 mm, middle finger 100 mm from its knuckle).
"""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any

import numpy as np

from recognizer.postures.types import Floats

FINGERS = ("index", "middle", "ring", "little")
BONES = {
    "index": (0.54, 0.30, 0.24),
    "middle": (0.57, 0.35, 0.25),
    "ring": (0.52, 0.33, 0.25),
    "little": (0.42, 0.24, 0.21),
}
KNUCKLES = {"index": (0.33, 1.06), "middle": (0.11, 1.12), "ring": (-0.12, 1.07), "little": (-0.33, 0.96)}
RADII = {
    "index": (0.125, 0.11, 0.10, 0.08),
    "middle": (0.125, 0.115, 0.10, 0.08),
    "ring": (0.12, 0.105, 0.095, 0.078),
    "little": (0.11, 0.095, 0.085, 0.07),
}
FAN = {"index": -1.0, "middle": -0.25, "ring": 0.35, "little": 1.1}  # share of the spread, towards the little finger
THUMB_BONES = np.array([0.50, 0.40, 0.34])
THUMB_RADII = (0.19, 0.15, 0.135, 0.095)
THUMB_BASE = np.array([0.25, 0.26, 0.08])

Piece = list[tuple[Floats, float]]  # the convex hull of balls: (centre (3,), radius) each


@dataclass(frozen=True)
class Posture:
    """One entry of `postures.toml`; its fields are explained there."""

    label: str
    extended: tuple[str, ...]
    spread: tuple[float, float]
    thumb: str
    yaw: tuple[float, float]
    action: str = ""
    touches: str = ""


@dataclass(frozen=True)
class Build:
    """Proportions of one person's hand against the average."""

    palm_width: float
    finger_length: float
    thickness: float
    thumb_length: float
    wrist: float
    arm: float

    @classmethod
    def draw(cls, rng: np.random.Generator) -> Build:
        """Draw a person."""
        return cls(*np.exp(rng.normal((0, 0, 0, 0, -0.02, 0), (0.07, 0.07, 0.09, 0.07, 0.08, 0.08))).tolist())


@cache
def postures() -> tuple[Posture, ...]:
    """Return the postures of `postures.toml`."""
    text = files("recognizer.postures.model_hand").joinpath("postures.toml").read_text(encoding="utf-8")
    entries: list[dict[str, Any]] = tomllib.loads(text)["posture"]
    return tuple(_posture(entry) for entry in entries)


def _posture(entry: dict[str, Any]) -> Posture:
    lists = {name: tuple(value) for name, value in entry.items() if isinstance(value, list)}
    return Posture(**{**entry, **lists})


@dataclass(frozen=True)
class Skeleton:
    """Joint positions: each finger and the thumb as (4, 3), root to tip."""

    fingers: dict[str, Floats]
    thumb: Floats

    def points(self) -> Floats:
        """Return all joints, (20, 3)."""
        return np.vstack([*self.fingers.values(), self.thumb])


def pose(posture: Posture, build: Build, rng: np.random.Generator) -> Skeleton:
    """Return one person's take of a posture: no two are alike."""
    flexion, sideways = _finger_angles(posture, rng)
    fingers = {name: _finger(name, flexion[name], sideways[name], build) for name in FINGERS}
    return Skeleton(fingers, _thumb(posture, fingers, build, rng))


def _finger_angles(posture: Posture, rng: np.random.Generator) -> tuple[dict[str, Floats], dict[str, float]]:
    """Return flexion of the three joints and sideways angle of each finger, degrees."""
    curled = rng.uniform((60, 85, 40), (95, 110, 75))
    closing = rng.uniform((25, 35, 15), (60, 75, 45))  # all fingers of the round O
    spread = rng.uniform(*posture.spread)
    lean = rng.normal(0, 3)
    flexion, sideways = {}, {}
    for order, name in enumerate(FINGERS):
        if name in posture.extended:
            flexion[name] = np.array([rng.normal(4, 7), abs(rng.normal(4, 6)), abs(rng.normal(3, 4))])
            sideways[name] = FAN[name] * spread + rng.normal(0, 2.5) + lean
        elif posture.thumb == "opposed":
            flexion[name] = closing + rng.normal(0, 5, 3) + 3 * order * rng.uniform()
            sideways[name] = FAN[name] * spread + rng.normal(0, 1)
        elif name == posture.touches:
            flexion[name] = rng.uniform((35, 45, 15), (70, 85, 50))
            sideways[name] = rng.normal(-4 if name == "index" else 0, 5)
        else:
            flexion[name] = curled + rng.normal(0, 6, 3)
            sideways[name] = FAN[name] * rng.uniform(0, 4) + rng.normal(0, 3) + lean
    return flexion, sideways


def _finger(name: str, flexion_deg: Floats, sideways_deg: float, build: Build) -> Floats:
    bend = np.cumsum(np.deg2rad(flexion_deg))
    side = np.deg2rad(sideways_deg)
    steps = np.column_stack([-np.sin(side) * np.cos(bend), np.cos(side) * np.cos(bend), np.sin(bend)])
    steps *= np.array(BONES[name])[:, None] * build.finger_length
    root = np.array([KNUCKLES[name][0] * build.palm_width, KNUCKLES[name][1], 0.0])
    return root + np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])


def _thumb(posture: Posture, fingers: dict[str, Floats], build: Build, rng: np.random.Generator) -> Floats:
    base = THUMB_BASE * [build.palm_width, 1, 1]
    lengths = THUMB_BONES * build.thumb_length
    width = build.palm_width
    if posture.thumb in ("out", "up"):
        out = posture.thumb == "out"
        first = rng.uniform(25, 48) if out else 25.0
        along = rng.uniform(15, 60) if out else rng.uniform(-10, 25)
        angles = np.deg2rad([first, along + rng.uniform(-8, 12), along + rng.normal(0, 12)])
        lift = np.array([rng.uniform(0, 0.3), *([rng.uniform(-0.1, 0.3)] * 2)])
        steps = np.column_stack([np.sin(angles), np.cos(angles), lift])
        steps *= (lengths / np.linalg.norm(steps, axis=1))[:, None]
        return base + np.vstack([np.zeros(3), np.cumsum(steps, axis=0)])
    if posture.thumb == "across":
        tip = rng.uniform((-0.15 * width, 0.55, 0.2), (0.25 * width, 0.95, 0.35))
        knees = ((0.2, 0.3, 0.25), (0.2, 0.6, 0.3))
    elif posture.thumb == "folded":
        beside = rng.uniform() < 0.2
        low, high = (
            ((0.34 * width, 0.8), (0.34 * width, 1.15)) if beside else ((-0.25 * width, 0.65), (0.2 * width, 1.0))
        )
        tip = rng.uniform((*low, 0.25), (*high, 0.5))
        knees = ((0.2, 0.35, 0.2), (0.2, 0.6, 0.35))
    elif posture.thumb == "touch":
        tip = fingers[posture.touches][3] + rng.uniform((-0.03, -0.1, -0.08), (0.05, 0.03, 0.0))
        knees = ((0.25, 0.25, 0.3), (0.4, 0.5, 0.5))
    else:  # opposed
        tip = 0.6 * fingers["index"][3] + 0.4 * fingers["middle"][3] + rng.uniform((0.05, -0.3, -0.05), (0.05, 0, 0.1))
        knees = ((0.1, 0.1, 0.4), (0.1, 0.35, 0.75))
    return reach(np.array([base, base + knees[0], base + knees[1], tip]), lengths, tip)


def reach(chain: Floats, lengths: Floats, target: Floats, iterations: int = 12) -> Floats:
    """Return the chain bent so that its end comes to the target, or as near as it reaches (FABRIK).

    Aristidou and Lasenby, "FABRIK: a fast, iterative solver for the inverse kinematics problem", 2011.

    Args:
        chain: (n + 1, 3) joints to start from; the first stays where it is.
        lengths: (n,) of the bones.
        target: (3,).
    """
    joints = np.array(chain, float)
    base = joints[0].copy()
    bones = range(len(lengths))
    for _ in range(iterations):
        joints[-1] = target
        for i in reversed(bones):
            joints[i] = joints[i + 1] + _along(joints[i] - joints[i + 1], lengths[i])
        joints[0] = base
        for i in bones:
            joints[i + 1] = joints[i] + _along(joints[i + 1] - joints[i], lengths[i])
    return joints


def _along(vector: Floats, length: float) -> Floats:
    return vector * (length / max(float(np.linalg.norm(vector)), 1e-9))
