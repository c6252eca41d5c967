"""How a person stands at rest in one clip, and sways while doing anything."""

from __future__ import annotations

import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.persons import Person
from nao_sim.people.arrays import Array
from nao_sim.people.performance.motions import SLIDES, hand_postures, joints, tables


def standing(person: Person, rng: Generator) -> Array:
    """This clip's way of standing at rest (nq,): arms hanging, hands relaxed, not quite facing the camera."""
    base = np.zeros(len(joints()))
    index = joints()

    def put(name: str, degrees: float) -> None:
        base[index[name]] = np.radians(degrees)

    for side, abduct in (("r_", person.right_rest), ("l_", person.left_rest)):
        put(f"{side}shoulder_abduct", abduct + rng.normal(0, 1.5))
        put(f"{side}shoulder_flex", rng.normal(2, 4))
        put(f"{side}elbow", rng.uniform(6, 24))
        put(f"{side}pronate", rng.uniform(10, 60))
        put(f"{side}hip_abduct", rng.uniform(1, 7))
        for joint, angle in hand_postures()["relaxed"].items():
            put(f"{side}{joint}", angle + rng.normal(0, 3))
    turn = rng.normal(0, 7)
    put("root_yaw", turn)
    put("head_yaw", -0.6 * turn + rng.normal(0, 4))
    put("head_pitch", rng.normal(2, 4))
    put("head_roll", rng.normal(0, 2.5))
    put("waist_roll", rng.normal(0, 1.5))
    put("chest_pitch", rng.normal(2, 3))
    return base


def sway_of_clip(rng: Generator, share: float | None = None) -> dict[int, Array]:
    """Three incommensurable sinusoids per swaying joint: rows (amplitude, Hz, phase).

    Args:
        rng: source of everything that varies.
        share: of clips in which somebody cannot keep still; by default as in the motion file.
    """
    restless = tables()["restless"]
    larger, quicker = 1.0, 1.0
    if rng.random() < (restless["share"] if share is None else share):
        larger = float(np.exp(rng.uniform(*np.log(restless["larger"]))))
        quicker = float(rng.uniform(*restless["quicker"]))
    found = {}
    for name, (deviation, period) in tables()["sway"].items():
        amount = deviation if name in SLIDES else np.radians(deviation)
        # Eyes rest on what they look at: the head turns less restlessly than the body it is carried by.
        amount *= np.sqrt(larger) if name.startswith("head_") else larger
        parts = rng.dirichlet([2.0, 1.5, 1.0]) ** 0.5
        # Large sways are slow ones: what is quick stays as small as it is in those who stand still.
        parts *= np.array([1.0, 1.0, larger**-0.5])
        rates = np.array([1.0, quicker, quicker]) * [1.0, 1.7, 3.1] * rng.uniform(0.7, 1.4, 3) / period
        found[joints()[name]] = np.stack([parts * amount * np.sqrt(2), rates, rng.uniform(0, 2 * np.pi, 3)], axis=1)
    return found
