"""Robots and rooms that are not quite as documented: the random factors of a stress test."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from nao_sim.robot import ACTUATED

Array = NDArray[np.float64]

# Half-widths of what a trial may draw at size 1, each about the nominal value.
MASS_SHARE = 0.10  # of every link's mass
COM_M = 0.008  # the torso's centre of mass, each axis
FRICTION = (0.4, 1.0)
STRENGTH_SHARE = 0.15  # of every motor's torque
PLAY_RAD = float(np.deg2rad(1.0))  # whole width of the gears' play in a leg joint; 1.0-1.4 degrees on real robots
DELAY_PERIODS = 1.0  # set-points come up to so many control periods late
SLOPE_RAD = float(np.deg2rad(2.0))
TILT_RAD = float(np.deg2rad(2.0))  # the robot starts leaning, on an edge of its soles
PUSH_NS = 0.3  # at the torso, horizontally, from any side
NOMINAL_FRICTION = 0.8

FACTORS = ("mass", "com", "friction", "strength", "play", "delay", "slope", "tilt", "push")


@dataclass(frozen=True, eq=False)
class Trials:
    """The factors of n trials.

    Attributes:
        mass: factor on each body's mass and inertia, shape (n, nbody).
        com_m: shift of the torso's centre of mass, shape (n, 3).
        friction: sliding friction of soles and floor, shape (n,).
        strength: factor on each motor's torque, shape (n, 25).
        play_rad: width of the play of each leg joint, shape (n,).
        delay: control periods that set-points come late, shape (n,), int.
        slope_rad, tilt_rad: rotation of the floor, and of the robot on it, about x and y, shape (n, 2).
        push_ns: impulse at the torso in x and y, shape (n, 2).
        push_at: when, as a share of the motion, shape (n,).
    """

    mass: Array
    com_m: Array
    friction: Array
    strength: Array
    play_rad: Array
    delay: NDArray[np.int64]
    slope_rad: Array
    tilt_rad: Array
    push_ns: Array
    push_at: Array

    def __len__(self) -> int:
        return len(self.friction)


def draw_trials(seed: int, indices: Sequence[int], nbody: int, sizes: Mapping[str, float] | None = None) -> Trials:
    """Draw trials; the same seed and index always give the same trial, whatever else is drawn.

    Args:
        seed: of the whole test.
        indices: numbers of the trials within it.
        nbody: bodies of the model.
        sizes: factor → how far it may go, in multiples of the constants above; a factor left out stays nominal.
            None for all factors at 1.
    """
    size = dict.fromkeys(FACTORS, 1.0) if sizes is None else {name: sizes.get(name, 0.0) for name in FACTORS}
    rows = [_draw(np.random.default_rng([seed, index]), nbody, size) for index in indices]
    return Trials(*(np.array(column) for column in zip(*rows, strict=True)))


def _draw(rng: np.random.Generator, nbody: int, size: Mapping[str, float]) -> tuple[Array | float | int, ...]:
    """Return one trial's factors in the order of :class:`Trials`; every number is drawn, whatever the sizes."""
    mass = 1.0 + MASS_SHARE * size["mass"] * rng.uniform(-1, 1, nbody)
    com = COM_M * size["com"] * rng.uniform(-1, 1, 3)
    middle, half = sum(FRICTION) / 2, (FRICTION[1] - FRICTION[0]) / 2
    spot = rng.uniform(-1, 1)
    friction = middle + half * size["friction"] * spot if size["friction"] else NOMINAL_FRICTION
    strength = 1.0 + STRENGTH_SHARE * size["strength"] * rng.uniform(-1, 1, len(ACTUATED))
    play = PLAY_RAD * size["play"] * rng.uniform()
    delay = round(DELAY_PERIODS * size["delay"] * rng.uniform())
    slope = SLOPE_RAD * size["slope"] * _disc(rng)
    tilt = TILT_RAD * size["tilt"] * _circle(rng)
    push = PUSH_NS * size["push"] * _circle(rng)
    # Nothing gets lighter than a tenth, smoother than ice, or weaker than a twentieth, however large the size.
    mass, strength = np.maximum(mass, 0.1), np.maximum(strength, 0.05)
    return mass, com, max(friction, 0.02), strength, play, delay, slope, tilt, push, rng.uniform(0.05, 0.95)


def _circle(rng: np.random.Generator) -> Array:
    angle = rng.uniform(0, 2 * np.pi)
    return np.array([np.cos(angle), np.sin(angle)])


def _disc(rng: np.random.Generator) -> Array:
    return _circle(rng) * np.sqrt(rng.uniform())
