"""The sample clips of ``assets/clips``: one of each class, small enough to travel with the project."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from nao_sim.people.dataset import photo_row, shot_row
from nao_sim.people.film import write_clip
from nao_sim.people.manifest import write_manifest
from nao_sim.people.motions import IRRELEVANT, motions
from nao_sim.people.persons import Person
from nao_sim.people.photos import DETAIL, Photo, draw_photo, postures, write_photo
from nao_sim.people.shots import Shot, draw_cast, draw_shot
from nao_sim.people.stage import Stage
from nao_sim.resources import resource


def samples_table() -> dict[str, Any]:
    """Return the tables of ``assets/people/samples.toml``."""
    with resource("assets", "people", "samples.toml").open("rb") as file:
        return tomllib.load(file)


def sample_labels() -> list[str]:
    """The classes that have a sample: all dynamic ones, then the static postures."""
    return [*(label for label in motions() if label != IRRELEVANT), *postures()]


def sample_shot(label: str, take: int | None = None) -> Shot:
    """A dynamic sample: the first take of fitting length and framing from ``take`` (by default the listed one) on."""
    table = samples_table()
    person = _person(table, label)
    first = table["take"].get(label, 0) if take is None else take
    shortest, longest = table["seconds"]
    for number in range(first, first + 200):
        shot = draw_shot(table["seed"], label, person, number)
        if shot.framing == "half" and shortest <= shot.performance.seconds <= longest:
            break
    size = table | table.get("larger", {}).get(label, {})
    sensor = replace(shot.sensor, quality=table["quality"], noise=table["noise"])
    return replace(shot, sensor=sensor, width=size["width"], height=size["height"], fps=float(size["fps"]))


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
            write_clip(stage, shot, out / f"{label}.avi")
            rows.append(shot_row(f"{label}.avi", shot))
            yield f"{label}.avi"
    with Stage(DETAIL) as stage:
        for label in postures():
            photo = sample_photo(label)
            write_photo(stage, photo, out / f"{label}.jpg")
            rows.append(photo_row(f"{label}.jpg", photo))
            yield f"{label}.jpg"
    write_manifest(out, rows)
