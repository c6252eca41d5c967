"""A shot: everything that one clip is made of, drawn from (seed, label, person, take) and nothing else."""

from __future__ import annotations

import tomllib
import zlib
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.clothes import Outfit, draw_outfit
from nao_sim.people.actors.persons import Person, draw_person
from nao_sim.people.filming.camera import Camera, Light
from nao_sim.people.filming.rooms import Item, draw_room
from nao_sim.people.filming.sensor import Sensor
from nao_sim.people.performance.perform import Performance, perform
from nao_sim.resources import resource

# Below this many pixels a metre a coarser figure looks the same, and takes half of the time.
_FINE_FROM = 260
COARSE = 0.75


@dataclass(frozen=True)
class Shot:
    """One clip before it is rendered."""

    label: str
    take: int
    person: Person
    outfit: Outfit
    room: list[Item]
    camera: Camera
    light: Light
    sensor: Sensor
    performance: Performance
    width: int
    height: int
    fps: float
    framing: str

    @property
    def frames(self) -> int:
        """How many frames the clip has."""
        return max(8, round(self.performance.seconds * self.fps))

    @property
    def detail(self) -> float:
        """The detail of the figure that the picture can show."""
        reach = float(np.linalg.norm(np.subtract(self.camera.pos, self.camera.aim)))
        metres = 2 * reach * self.camera.slope
        return COARSE if self.height / metres < _FINE_FROM else 1.0


@lru_cache
def cameras() -> dict[str, Any]:
    """Return the tables of ``assets/people/cameras.toml``."""
    with resource("assets", "people", "cameras.toml").open("rb") as file:
        return tomllib.load(file)


@lru_cache(maxsize=4)
def draw_cast(seed: int, persons: int, children: float = 1 / 3) -> tuple[Person, ...]:
    """The persons of a data set; every third is a child, or another share of them."""
    young = np.floor((np.arange(persons) + 1) * children) > np.floor(np.arange(persons) * children)
    return tuple(draw_person(f"p{k:03d}", np.random.default_rng([seed, 1, k]), bool(young[k])) for k in range(persons))


def generator(seed: int, label: str, person: str, take: int, use: str) -> Generator:
    """The random stream of one use in one clip; the same on every machine and in every order."""
    return np.random.default_rng([seed, *(zlib.crc32(text.encode()) for text in (label, person, use)), take])


def draw_shot(
    seed: int,
    label: str,
    person: Person,
    take: int,
    action: str | None = None,
    restless: float | None = None,
    underway: float | None = None,
) -> Shot:
    """Draw the clip ``take`` of ``person`` performing ``label``; the last three are those of :func:`perform`."""
    table = cameras()
    rng = generator(seed, label, person.name, take, "scene")
    width, height, _ = weighted(table["sizes"], rng)
    fps = float(weighted(table["frame_rates"], rng)[0])
    framing, camera, half_width = _frame(label, person, width / height, table, rng)
    acting = generator(seed, label, person.name, take, "act")
    return Shot(
        label=label,
        take=take,
        person=person,
        outfit=draw_outfit(rng),
        room=draw_room(rng, float(rng.uniform(0, 1))),
        camera=camera,
        light=draw_light(rng),
        sensor=Sensor.draw(table["sensor"], rng),
        performance=perform(label, person, acting, half_width, action, restless, underway),
        width=int(width),
        height=int(height),
        fps=fps,
        framing=framing,
    )


def weighted(rows: Sequence[Sequence[float]], rng: Generator) -> Sequence[float]:
    """Draw a row by the share in its last column."""
    share = np.array([row[-1] for row in rows], dtype=float)
    return rows[int(rng.choice(len(rows), p=share / share.sum()))]


def _frame(
    label: str, person: Person, aspect: float, table: dict[str, Any], rng: Generator
) -> tuple[str, Camera, float]:
    """Framing name, camera, and half of the width (m) seen at the person."""
    framings = {name: row | row.get("for", {}).get(label, {}) for name, row in table["framing"].items()}
    open_to = {name: row for name, row in framings.items() if label in row.get("only", [label])}
    share = np.array([row["share"] for row in open_to.values()], dtype=float)
    name = list(open_to)[int(rng.choice(len(open_to), p=share / share.sum()))]
    row = open_to[name]
    if "fill" in row:
        high = person.stature / rng.uniform(*row["fill"])
        top = person.stature + (high - person.stature) * rng.uniform(*row["above"])
    else:
        high = person.stature * rng.uniform(*row["high"])
        top = person.stature * (1 + rng.uniform(*row["above"]))
    # A tall image is narrow: step back until the arms fit in.
    high *= max(1.0, 1.2 / aspect)
    fovy = float(rng.uniform(*table["fovy_deg"]))
    distance = high / 2 / np.tan(np.radians(fovy) / 2)
    azimuth = np.radians(rng.uniform(-1, 1) * table["azimuth_deg"])
    aside = rng.normal(0, table["off_centre"]) * high * aspect * (0.5 if name == "close" else 0.8)
    middle = top - high / 2
    lens = float(rng.uniform(*table["height"])) * person.stature / 1.75
    # Seen from the side, the camera aims past the person by the same lateral offset.
    aim = (0.0, float(aside), float(middle))
    level = np.sqrt(max(distance**2 - (lens - middle) ** 2, (0.5 * distance) ** 2))
    pos = (float(level * np.cos(azimuth)), float(aside + level * np.sin(azimuth)), lens)
    camera = Camera(pos, aim, fovy, float(rng.normal(0, table["roll_deg"])))
    return name, camera, float(high * aspect / 2)


def draw_light(rng: Generator) -> Light:
    """A key light from somewhere in front and above, a weaker fill from the other side, and ambient light."""
    table = cameras()["light"]

    def strength(name: str) -> tuple[float, float, float]:
        r, g, b = np.clip(rng.uniform(*table[name]) * (1 + rng.normal(0, table["warmth"], 3)), 0, 1)
        return float(r), float(g), float(b)

    side = float(rng.choice([-1, 1]))
    key_dir = (-1.0, -side * float(rng.uniform(0.1, 1.2)), -float(rng.uniform(0.4, 1.6)))
    fill_dir = (-1.0, side * float(rng.uniform(0.3, 1.2)), -float(rng.uniform(-0.1, 0.8)))
    return Light(key_dir, strength("key"), fill_dir, strength("fill"), strength("ambient"))
