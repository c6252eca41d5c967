"""Who is filmed: stature, build and looks of a person, drawn from a seed, and what that means for each body.

Segment lengths of adults are the fractions of stature of Drillis & Contini (1966, as printed in Winter, *Biomechanics
and Motor Control of Human Movement*, 4th ed., fig. 4.1), which ``models/person/person.xml`` holds for 1.75 m. Children
have larger heads and shorter legs and arms: straight lines through the means of Snyder et al., *Anthropometry of
Infants, Children and Youths to Age 18* (UMTRI, 1977), for 1.10 m and 1.60 m.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from nao_sim.people.arrays import Array
from nao_sim.resources import resource

NOMINAL_STATURE = 1.75
CHILD_STATURE = 1.5
ARM = ("upper_arm", "forearm")
FINGERS = ("index", "middle", "ring", "little")


@dataclass(frozen=True)
class Person:
    """One person: the same body, skin and hair in every clip; clothes change with the clip.

    Attributes:
        name: identifier used in file names and manifests, such as ``p007``.
        stature: m, 1.10 to 1.95.
        girth: limb and trunk thickness relative to the nominal person of that stature.
        shoulders, hips: breadth factors.
        head, hand, arm, leg: size or length factors beside those that follow from stature.
        fingers: girth factor of the fingers.
        skin, hair: sRGB in [0, 1].
        hair_style: the hair part shown, or ``bald``.
        left_rest, right_rest: how far (degrees) the arms hang from the body.
        liveliness: factor on sway and on how much the rest of the body joins in.
    """

    name: str
    stature: float
    girth: float
    shoulders: float
    hips: float
    head: float
    hand: float
    arm: float
    leg: float
    fingers: float
    skin: tuple[float, float, float]
    hair: tuple[float, float, float]
    hair_style: str
    left_rest: float
    right_rest: float
    liveliness: float

    @property
    def is_child(self) -> bool:
        """Whether the person counts as a child (stature under 1.5 m)."""
        return self.stature < CHILD_STATURE


@lru_cache
def wardrobe() -> dict[str, Any]:
    """Return the tables of ``assets/people/wardrobe.toml``."""
    with resource("assets", "people", "wardrobe.toml").open("rb") as file:
        return tomllib.load(file)


def draw_person(name: str, rng: Generator, child: bool) -> Person:
    """Draw a person; ``child`` decides between 1.10 to 1.50 m and 1.50 to 1.95 m."""
    stature = rng.uniform(1.10, 1.495) if child else float(np.clip(rng.normal(1.70, 0.1), 1.5, 1.95))
    table = wardrobe()
    styles = dict(table["hair_style"])
    if child:
        styles["bald"] = 0.0
    return Person(
        name=name,
        stature=float(stature),
        girth=float(np.clip(rng.normal(1.03, 0.11), 0.82, 1.38)),
        shoulders=float(rng.normal(1.0 if not child else 0.97, 0.045)),
        hips=float(rng.normal(1.0, 0.05)),
        head=float(rng.normal(1.0, 0.03)),
        hand=float(rng.normal(1.0, 0.05)),
        arm=float(rng.normal(1.0, 0.025)),
        leg=float(rng.normal(1.0, 0.02)),
        fingers=float(rng.normal(1.14, 0.09)),
        skin=_skin(rng, table),
        hair=_mix(table["hair"][int(rng.integers(len(table["hair"])))], rng, 8),
        hair_style=choose(styles, rng),
        left_rest=float(rng.uniform(3, 13)),
        right_rest=float(rng.uniform(3, 13)),
        liveliness=float(rng.uniform(0.6, 1.6)),
    )


def choose(shares: Mapping[str, float], rng: Generator) -> str:
    """Draw a key of ``shares`` with probability proportional to its value."""
    names = list(shares)
    weight = np.array([shares[n] for n in names], dtype=float)
    return names[int(rng.choice(len(names), p=weight / weight.sum()))]


def _skin(rng: Generator, table: dict[str, Any]) -> tuple[float, float, float]:
    """A tone between two neighbours of the scale, warmed by blood."""
    tones = np.array(table["skin"], dtype=float)
    at = rng.uniform(0, len(tones) - 1)
    low = min(int(at), len(tones) - 2)
    tone = tones[low] + (at - low) * (tones[low + 1] - tones[low])
    share = rng.uniform(*table["blood_share"])
    # Blood shows as a shift of hue at the tone's own lightness, so dark skin stays dark.
    blood = np.array(table["blood"]) * tone.mean() / np.mean(table["blood"])
    return _mix((1 - share) * tone + share * blood, rng, 4)


def _mix(rgb: Any, rng: Generator, spread: float) -> tuple[float, float, float]:
    """An sRGB colour (0 to 255) with a little of its own, as (r, g, b) in [0, 1]."""
    r, g, b = np.clip(np.asarray(rgb, dtype=float) + rng.normal(0, spread, 3), 6, 250) / 255
    return float(r), float(g), float(b)


def body_scales(person: Person) -> dict[str, Array]:
    """Scale factors (3,) along x, y, z of every body that differs from the 1.75 m person."""
    tall = person.stature / NOMINAL_STATURE
    # From adult (0) to a five-year-old of 1.10 m (1).
    young = float(np.clip((1.65 - person.stature) / 0.55, 0.0, 1.0))
    leg = tall * (1 - 0.085 * young) * person.leg
    arm = tall * (1 - 0.04 * young) * person.arm
    hand = tall * (1 - 0.03 * young) * person.hand
    girth = tall * person.girth * (1 + 0.04 * young)
    head = _head_size(person) / 0.2325 * person.head
    trunk = tall * (1 + 0.015 * young)
    scales = {
        "pelvis": _xyz(girth, tall * (person.hips * person.girth) ** 0.5, trunk),
        "waist": _xyz(girth, tall * person.girth * (1 + 0.05 * young), trunk),
        "chest": _xyz(girth, tall * (person.shoulders * person.girth) ** 0.5, trunk),
        "neck": _xyz(girth * 0.97, girth * 0.97, tall * (1 - 0.12 * young)),
        "head": _xyz(head, head, head),
    }
    for side in ("r_", "l_"):
        scales[f"{side}clavicle"] = _xyz(girth, tall * person.shoulders, girth)
        scales |= {f"{side}{body}": _xyz(girth, girth, arm) for body in ARM}
        scales |= {f"{side}{body}": _xyz(girth, girth, leg) for body in ("thigh", "shin")}
        scales[f"{side}foot"] = _xyz(tall, tall, tall)
        scales |= {f"{side}{body}": _xyz(hand, hand, hand) for body in ("wrist", "hand")}
        thick = hand * person.fingers
        scales |= {f"{side}thumb_{k}": _xyz(thick, thick, hand) for k in (1, 2, 3)}
        scales |= {f"{side}{finger}_{k}": _xyz(thick, thick, hand) for finger in FINGERS for k in (1, 2, 3)}
    return scales


def _head_size(person: Person) -> float:
    """Height of the head (m): 0.195 at 1.10 m of stature, 0.2325 at 1.75 m (Snyder 1977; Tilley 2002)."""
    return 0.195 + (person.stature - 1.10) / 0.65 * 0.0375


def _xyz(x: float, y: float, z: float) -> NDArray[np.float64]:
    return np.array([x, y, z])
