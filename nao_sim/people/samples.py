"""The sample clips of ``assets/clips``: one of each class, small enough to travel with the project."""

from __future__ import annotations

import tomllib
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path
from typing import Any

from nao_sim.people.dataset import shot_row, write_manifest
from nao_sim.people.film import write_clip
from nao_sim.people.motions import IRRELEVANT, motions
from nao_sim.people.shots import Shot, draw_cast, draw_shot
from nao_sim.people.stage import Stage
from nao_sim.resources import resource


def sample_shots() -> list[tuple[str, Shot]]:
    """File names and shots of the samples, from ``assets/people/samples.toml``."""
    with resource("assets", "people", "samples.toml").open("rb") as file:
        table = tomllib.load(file)
    return [(f"{label}.avi", _shot(table, label, k)) for k, label in enumerate(_labels())]


def _labels() -> list[str]:
    return [label for label in motions() if label != IRRELEVANT]


def _shot(table: dict[str, Any], label: str, k: int) -> Shot:
    """A shot of ``label``, made small; the first take of fitting length and framing from the listed one on."""
    cast = draw_cast(table["seed"], table["persons"])
    first = table["take"].get(label, 0)
    shortest, longest = table["seconds"]
    shot = draw_shot(table["seed"], label, cast[k % len(cast)], first)
    for take in range(first, first + 60):
        shot = draw_shot(table["seed"], label, cast[k % len(cast)], take)
        if shot.framing == "half" and shortest <= shot.performance.seconds <= longest:
            break
    size = table | table.get("larger", {}).get(label, {})
    sensor = replace(shot.sensor, quality=table["quality"], noise=table["noise"])
    return replace(shot, sensor=sensor, width=size["width"], height=size["height"], fps=float(size["fps"]))


def film_samples(out: Path) -> Iterator[str]:
    """Write the samples and their manifest into ``out``, yielding each file's name when it stands."""
    rows = []
    with Stage() as stage:
        for name, shot in sample_shots():
            write_clip(stage, shot, out / name)
            rows.append(shot_row(name, shot))
            yield name
    write_manifest(out, rows)
