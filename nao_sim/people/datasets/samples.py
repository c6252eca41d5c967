"""The sample clips of ``assets/clips``: one of each class, small enough to travel with the project."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.figure import skeleton
from nao_sim.people.actors.persons import Person
from nao_sim.people.arrays import Array
from nao_sim.people.datasets.dataset import photo_row, shot_row
from nao_sim.people.datasets.manifest import write_manifest
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.camera import Light
from nao_sim.people.filming.film import write_clip
from nao_sim.people.filming.photos import DETAIL, Photo, draw_photo, postures, write_photo
from nao_sim.people.filming.rooms import Item, draw_room
from nao_sim.people.filming.shots import Shot, draw_cast, draw_shot, generator
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import IRRELEVANT, motions
from nao_sim.resources import resource

# Bodies that end where the person ends, and the offset (m) of that end, with 5 cm to spare.
_ENDS = (("head", (0.0, 0.0, 0.25)), ("r_middle_3", (0.0, 0.0, -0.07)), ("l_middle_3", (0.0, 0.0, -0.07)))


def samples_table() -> dict[str, Any]:
    """Return the tables of ``assets/people/samples.toml``."""
    with resource("assets", "people", "samples.toml").open("rb") as file:
        return tomllib.load(file)


def sample_labels() -> list[str]:
    """The classes that have a sample: all dynamic ones, then the static postures."""
    return [*(label for label in motions() if label != IRRELEVANT), *postures()]


def sample_shot(label: str, take: int | None = None) -> Shot:
    """A dynamic sample: the first take from ``take`` (by default the listed one) on that suits.

    Person, camera and performance are those of the take; room, light and sensor are the clear ones of the table.

    Raises:
        FilmError: none of 400 takes has the length of a sample and keeps head and hands in the picture.
    """
    table = samples_table()
    table |= table["for"].get(label, {})
    person = _person(table, label)
    first = table["take"].get(label, 0) if take is None else take
    for number in range(first, first + 400):
        shot = draw_shot(table["seed"], label, person, number, restless=0.0, underway=0.0)
        shot = replace(shot, width=table["width"], height=table["height"])
        if _suits(shot, table):
            break
    else:
        raise FilmError(f"no take of '{label}' shows head and hands throughout; widen 'seconds' in samples.toml")
    clear = {"gain": np.ones(3), "drift": np.zeros((0, 3)), "flicker": (0.0, 1.0), **table["sensor"]}
    return replace(
        shot,
        room=_plain_room(table, generator(table["seed"], label, person.name, number, "sample")),
        light=Light(**{name: tuple(value) for name, value in table["light"].items()}),
        sensor=replace(shot.sensor, **clear),
        fps=float(table["fps"]),
    )


def _plain_room(table: dict[str, Any], rng: Generator) -> list[Item]:
    """A room whose floor and wall have no pattern: patterns take most of a small JPEG."""
    while True:
        room = draw_room(rng, table["clutter"])
        if {item.texture for item in room[:2]} <= set(table["textures"]):
            return room


def _suits(shot: Shot, table: dict[str, Any]) -> bool:
    """Whether the take is as long as a sample, its person large enough, and head and hands stay in the picture."""
    shortest, longest = table["seconds"]
    top = shot.camera.project(np.array([0.0, 0.0, shot.person.stature]))
    foot = shot.camera.project(np.zeros(3))
    if not shortest <= shot.performance.seconds <= longest or top[1] - foot[1] < 2 * table["fill"]:
        return False
    shown = np.abs(shot.camera.project(head_and_hands(shot))) <= (shot.width / shot.height, 1.0)
    if shot.performance.walk is not None:  # comes in and goes out at the sides
        return bool(shown[..., 1].all())
    return bool(shown.all())


def head_and_hands(shot: Shot, count: int = 24) -> Array:
    """World positions (count, 3, 3) in m of the top of the head and the two middle finger tips, over the clip.

    They are those of the person of 1.75 m scaled to the stature, a few centimetres off for other builds.
    """
    model = skeleton().compile()
    data = mujoco.MjData(model)
    ends = [(data.body(name), offset) for name, offset in _ENDS]
    places = []
    for angles in shot.performance.angles(np.linspace(0, shot.performance.seconds, count)):
        data.qpos[:] = angles
        mujoco.mj_kinematics(model, data)
        places.append([body.xpos + body.xmat.reshape(3, 3) @ offset for body, offset in ends])
    return np.array(places) * shot.person.stature / 1.75


def sample_photo(label: str, take: int | None = None) -> Photo:
    """A static sample: the first close-up from ``take`` (by default the listed one) on."""
    table = samples_table()
    first = table["take"].get(label, 0) if take is None else take
    for number in range(first, first + 200):
        photo = draw_photo(table["seed"], label, _person(table, label), number)
        if photo.close and photo.width == photo.height:
            break
    return replace(photo, width=table["photo"], height=table["photo"])


def _person(table: dict[str, Any], label: str) -> Person:
    cast = draw_cast(table["seed"], table["persons"])
    return cast[sample_labels().index(label) % len(cast)]


def film_samples(out: Path) -> Iterator[str]:
    """Write the samples and their manifest into ``out``, yielding each file's name when it stands."""
    static = set(postures())
    rows = []
    with Stage() as stage:
        for label in (label for label in sample_labels() if label not in static):
            shot = sample_shot(label)
            write_clip(stage, shot, out / f"{label}.avi", fine=True)
            rows.append(shot_row(f"{label}.avi", shot))
            yield f"{label}.avi"
    with Stage(DETAIL) as stage:
        for label in postures():
            photo = sample_photo(label)
            write_photo(stage, photo, out / f"{label}.jpg")
            rows.append(photo_row(f"{label}.jpg", photo))
            yield f"{label}.jpg"
    write_manifest(out, rows)
