"""Rooms: walls, floor and furniture as a list of boxes and ellipsoids, drawn from a seed.

The camera looks along -x from in front of a person who stands at the origin; y is to the image's right.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache

import mujoco
import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from nao_sim.people.arrays import Array

MAX_ITEMS = 40
FACING = np.array([0.5, 0.5, 0.5, 0.5])  # turns a box's z to +x and its y up: its texture faces the camera
BOX, BALL = int(mujoco.mjtGeom.mjGEOM_BOX), int(mujoco.mjtGeom.mjGEOM_ELLIPSOID)
# Texture -> repeats per metre; 0 stretches one copy over the item.
TEXTURES = {
    "plain": 0.0, "noise": 0.6, "planks": 0.7, "bricks": 1.0, "stripes": 0.6, "tiles": 0.5,
    "books": 0.0, "window": 0.0, "poster": 0.0, "curtain": 0.0,
}  # fmt: skip


@dataclass(frozen=True)
class Item:
    """One thing in a room: a geom type, position (m), half sizes (m), orientation, sRGB colour and texture."""

    kind: int
    pos: tuple[float, float, float]
    size: tuple[float, float, float]
    rgb: tuple[float, float, float]
    texture: str = "plain"
    quat: NDArray[np.float64] | None = None


@lru_cache
def texture_images(size: int = 128) -> dict[str, NDArray[np.uint8]]:
    """Grey-to-coloured patterns (size, size, 3) that the colour of an item multiplies."""
    rng = np.random.default_rng(7)
    y, x = np.mgrid[0:size, 0:size] / size
    cloud = sum(_cloud(rng, size, n) / k for k, n in enumerate((4, 8, 16, 32), start=1)) / 2.1
    grain = rng.normal(0, 0.03, (size, size))
    shelf = 1 - 0.75 * (np.abs((y * 4) % 1 - 0.5) > 0.46)
    width = rng.integers(2, 6, 200)
    book = np.repeat(rng.uniform(0.15, 0.9, (200, 1)) * rng.uniform(0.6, 1.1, (200, 3)), width, axis=0)[
        : size * 4
    ].reshape(4, size, 3)
    books = np.repeat(book, size // 4, axis=0) * shelf[:, :, None]
    bricks = 1 - 0.45 * ((((y * 8) % 1) < 0.1) | (((x * 4 + 0.5 * (np.floor(y * 8) % 2)) % 1) < 0.05))
    bars = ((np.abs(x - 0.5) < 0.02) | (np.abs(y - 0.5) < 0.02)) | (np.maximum(np.abs(x - 0.5), np.abs(y - 0.5)) > 0.46)
    poster = np.stack([_cloud(rng, size, n) for n in (3, 4, 5)], axis=2)
    plain = {
        "plain": 0.97 + grain * 0.3,
        "noise": 0.75 + 0.25 * cloud + grain,
        "planks": (0.8 + 0.12 * np.sin(40 * x + 4 * cloud) + grain) * (1 - 0.35 * ((y * 6) % 1 < 0.05)),
        "bricks": bricks * (0.85 + grain),
        "stripes": 0.72 + 0.25 * np.sign(np.sin(2 * np.pi * 8 * x)),
        "window": np.where(bars, 0.55, 1.0) * (0.8 + 0.2 * (1 - y)),
        "tiles": 1 - 0.25 * (((x * 6) % 1 < 0.05) | ((y * 6) % 1 < 0.05)) + grain * 0.5,
        "curtain": 0.75 + 0.22 * np.sin(2 * np.pi * 9 * x + 2 * cloud),
    }
    images = {name: np.repeat(value[:, :, None], 3, axis=2) for name, value in plain.items()}
    images |= {"books": books, "poster": poster}
    return {name: (np.clip(images[name], 0, 1) * 255).astype(np.uint8) for name in TEXTURES}


def _cloud(rng: Generator, size: int, cells: int) -> Array:
    """Smooth noise in [0, 1]: random corner values, bilinearly enlarged to (size, size)."""
    coarse = rng.random((cells + 1, cells + 1))
    at = np.arange(size) * cells / size
    low = at.astype(int)
    part = at - low
    rows = coarse[low] * (1 - part)[:, None] + coarse[low + 1] * part[:, None]
    return rows[:, low] * (1 - part) + rows[:, low + 1] * part


def draw_room(rng: Generator, clutter: float) -> list[Item]:
    """Draw a room; ``clutter`` in [0, 1] goes from a bare wall to a full office."""
    depth = rng.uniform(0.5, 3.2)
    wall = _wall_colour(rng)
    texture = str(rng.choice(["plain", "plain", "noise", "bricks", "stripes", "planks", "tiles"]))
    floor = str(rng.choice(["planks", "noise", "tiles", "plain"]))
    room = [
        Item(BOX, (0, 0, -0.1), (9, 9, 0.1), _colour(rng, 0.25, 0.75, 0.12), floor),
        Item(BOX, (-depth - 0.1, 0, 1.6), (12, 8, 0.1), wall, texture, FACING),
    ]
    if rng.random() < 0.3:  # a lower half of another colour, as on panelled or partitioned walls
        room.append(
            Item(BOX, (-depth, 0, 0.5), (0.02, 9, rng.uniform(0.3, 0.7)), _colour(rng, 0.2, 0.8, 0.18), "plain")
        )
    pieces = round(clutter * int(rng.integers(3, 12)))
    for k in range(pieces):
        # Furniture that stands before a near wall would stand before the person.
        choice = _PIECES if depth > 1.3 else _FLAT
        piece = choice[int(rng.integers(len(choice)))](rng, depth)
        # What hangs over something else hangs a little before it; at one depth both would shimmer through.
        room += [replace(item, pos=(item.pos[0] + 0.008 * k, *item.pos[1:])) for item in piece]
    return room[:MAX_ITEMS]


def _wall_colour(rng: Generator) -> tuple[float, float, float]:
    kind = rng.random()
    if kind < 0.5:
        return _colour(rng, 0.6, 0.97, 0.08)
    if kind < 0.6:  # skin-coloured plaster
        return 0.85 * rng.uniform(0.9, 1.1), 0.68 * rng.uniform(0.95, 1.05), 0.55 * rng.uniform(0.95, 1.05)
    return _colour(rng, 0.25, 0.9, 0.2)


def _colour(rng: Generator, low: float, high: float, chroma: float) -> tuple[float, float, float]:
    r, g, b = np.clip(rng.uniform(low, high) + rng.uniform(-chroma, chroma, 3), 0.03, 1.0)
    return float(r), float(g), float(b)


def _across(rng: Generator) -> float:
    """A lateral place, m: anywhere, not only beside the person."""
    return float(rng.uniform(-2.6, 2.6))


def _picture(rng: Generator, depth: float) -> list[Item]:
    size = (rng.uniform(0.12, 0.5), rng.uniform(0.12, 0.45), 0.01)
    place = (-depth + 0.01, _across(rng), rng.uniform(1.1, 2.1))
    return [Item(BOX, place, size, _colour(rng, 0.4, 1, 0.3), str(rng.choice(["poster", "plain", "stripes"])), FACING)]


def _window(rng: Generator, depth: float) -> list[Item]:
    place = (-depth + 0.012, _across(rng), rng.uniform(1.4, 1.9))
    glow = rng.uniform(0.85, 1.0)
    size = (rng.uniform(0.4, 0.9), rng.uniform(0.4, 0.7), 0.01)
    return [Item(BOX, place, size, (glow, glow, 1.0), "window", FACING)]


def _door(rng: Generator, depth: float) -> list[Item]:
    tone = rng.uniform(0.5, 1.0)
    rgb = (0.86 * tone, 0.66 * tone, 0.5 * tone) if rng.random() < 0.6 else _colour(rng, 0.3, 0.95, 0.2)
    y = _across(rng)
    knob = Item(BALL, (-depth + 0.08, y + 0.36, 1.0), (0.04, 0.04, 0.04), (0.5, 0.5, 0.5))
    return [Item(BOX, (-depth + 0.011, y, 1.0), (0.43, 1.0, 0.01), rgb, "plain", FACING), knob]


def _shelf(rng: Generator, depth: float) -> list[Item]:
    y, width, height = _across(rng), rng.uniform(0.35, 0.8), rng.uniform(0.4, 1.0)
    body = Item(BOX, (-depth + 0.15, y, height), (0.14, width, height), _colour(rng, 0.2, 0.7, 0.15), "plain")
    front = Item(BOX, (-depth + 0.295, y, height), (width * 0.95, height * 0.96, 0.01), (1, 1, 1), "books", FACING)
    return [body, front]


def _table(rng: Generator, depth: float) -> list[Item]:
    y, width, height = _across(rng), rng.uniform(0.4, 1.0), rng.uniform(0.6, 0.8)
    x = -depth + rng.uniform(0.35, 0.5)
    wood = _colour(rng, 0.25, 0.8, 0.2)
    top = Item(BOX, (x, y, height), (0.3, width, 0.02), wood, "planks")
    legs = [Item(BOX, (x, y + side * (width - 0.05), height / 2), (0.25, 0.025, height / 2), wood) for side in (-1, 1)]
    screen = Item(BOX, (x, y + rng.uniform(-0.3, 0.3), height + 0.25), (0.02, 0.25, 0.17), (0.08, 0.08, 0.1))
    return [top, *legs, screen] if rng.random() < 0.6 else [top, *legs]


def _sofa(rng: Generator, depth: float) -> list[Item]:
    y, rgb = _across(rng), _colour(rng, 0.1, 0.8, 0.3)
    x = -depth + 0.4
    return [
        Item(BOX, (x, y, 0.22), (0.4, 0.8, 0.2), rgb, "noise"),
        Item(BOX, (x - 0.3, y, 0.55), (0.12, 0.8, 0.3), rgb, "noise"),
    ]


def _plant(rng: Generator, depth: float) -> list[Item]:
    y, height = _across(rng), rng.uniform(0.5, 1.3)
    x, green = -depth + 0.3, (0.1, rng.uniform(0.25, 0.5), 0.12)
    leaves = [
        Item(BALL, (x + rng.uniform(-0.1, 0.1), y + rng.uniform(-0.2, 0.2), height + rng.uniform(-0.2, 0.3)),
             (rng.uniform(0.08, 0.2), rng.uniform(0.08, 0.2), rng.uniform(0.1, 0.3)), green, "noise")
        for _ in range(4)
    ]  # fmt: skip
    return [Item(BOX, (x, y, 0.2), (0.14, 0.14, 0.2), _colour(rng, 0.3, 0.8, 0.2)), *leaves]


def _curtain(rng: Generator, depth: float) -> list[Item]:
    place = (-depth + 0.02, _across(rng), 1.3)
    return [Item(BOX, place, (rng.uniform(0.2, 0.6), 1.2, 0.01), _colour(rng, 0.2, 0.9, 0.35), "curtain", FACING)]


def _lamp(rng: Generator, depth: float) -> list[Item]:
    y, height = _across(rng), rng.uniform(1.2, 1.6)
    pole = Item(BOX, (-depth + 0.25, y, height / 2), (0.015, 0.015, height / 2), (0.2, 0.2, 0.2))
    return [pole, Item(BALL, (-depth + 0.25, y, height), (0.15, 0.15, 0.17), (1.0, 0.95, 0.8))]


_FLAT = (_picture, _picture, _window, _door, _curtain)
_PIECES = (*_FLAT, _shelf, _shelf, _table, _table, _sofa, _plant, _lamp)
