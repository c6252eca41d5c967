"""What a person wears in one clip, and how that colours and thickens the parts of the figure."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.figure import HIDDEN_GROUP
from nao_sim.people.actors.persons import Person, choose, wardrobe

Rgb = tuple[float, float, float]
# Which parts of the arm and the leg each garment covers.
SLEEVES = {
    "none": (),
    "short": ("upper_sleeve",),
    "elbow": ("upper_sleeve", "lower_sleeve"),
    "long": ("upper_sleeve", "lower_sleeve", "cuff"),
}
LEGS = {"trousers": ("hips", "thigh", "shin"), "shorts": ("hips", "thigh"), "skirt": ("hips",)}
OPTIONAL = ("hair_short", "hair_long", "hair_bun", "skirt", "watch")


@dataclass(frozen=True)
class Outfit:
    """Clothes of one clip; colours are sRGB in [0, 1], thicknesses in m."""

    sleeves: str
    legs: str
    top: Rgb
    bottom: Rgb
    shoes: Rgb
    print: Rgb | None
    watch: Rgb | None
    thickness: float


def draw_outfit(rng: Generator) -> Outfit:
    """Draw clothes independently of the person."""
    table = wardrobe()

    def pick(name: str) -> Rgb:
        colours = table[name]
        r, g, b = np.clip(np.array(colours[int(rng.integers(len(colours)))]) + rng.normal(0, 7, 3), 4, 252) / 255
        return float(r), float(g), float(b)

    return Outfit(
        sleeves=choose(table["sleeves"], rng),
        legs=choose(table["legs"], rng),
        top=pick("cloth"),
        bottom=pick("trousers"),
        shoes=pick("shoes"),
        print=pick("cloth") if rng.random() < table["print_share"] else None,
        watch=pick("shoes") if rng.random() < table["watch_share"] else None,
        thickness=float(rng.uniform(0.004, 0.016)),
    )


def thicknesses(outfit: Outfit) -> dict[str, float]:
    """How far (m) each covered part lies outside the skin."""
    covered = ("torso", *SLEEVES[outfit.sleeves], *LEGS[outfit.legs])
    thick = dict.fromkeys(covered, outfit.thickness)
    thick["print"] = outfit.thickness
    return thick


def dress(model: mujoco.MjModel, person: Person, outfit: Outfit) -> None:
    """Colour the skins of ``model`` and show the hair, skirt, print and watch that this clip has."""
    colours: dict[str, Rgb] = {"torso": outfit.top, "shoe": outfit.shoes}
    colours |= dict.fromkeys(SLEEVES[outfit.sleeves], outfit.top)
    colours |= dict.fromkeys((*LEGS[outfit.legs], "skirt"), outfit.bottom)
    dark = (0.07, 0.05, 0.045)
    colours |= {
        "eyes": dark,
        "whites": (0.86, 0.84, 0.82),
        "brows": _shade(person.hair, 0.6),
        person.hair_style: person.hair,
    }
    r, g, b = person.skin
    # Palms are paler than the rest of dark skin.
    pale = 0.4 * (1 - (r + g + b) / 3)
    colours["hand"] = (r + pale * (0.78 - r), g + pale * (0.56 - g), b + pale * (0.46 - b))
    colours["lips"] = (r * 0.85, g * 0.62, b * 0.62)
    shown = {person.hair_style}
    if outfit.legs == "skirt":
        shown.add("skirt")
    if outfit.watch is not None:
        shown.add("watch")
        colours["watch"] = outfit.watch
    colours["print"] = outfit.print or outfit.top
    for skin in range(model.nskin):
        name = mujoco.mj_id2name(model, mujoco.mjtObj.mjOBJ_SKIN, skin)
        model.skin_rgba[skin, :3] = colours.get(name, person.skin)
        model.skin_group[skin] = HIDDEN_GROUP if name in OPTIONAL and name not in shown else 0


def _shade(rgb: Rgb, factor: float) -> Rgb:
    return rgb[0] * factor, rgb[1] * factor, rgb[2] * factor
