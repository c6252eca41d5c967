"""Photos of the static hand postures: a hand in close-up, or a person with face, arm and hand in view."""

from __future__ import annotations

import os
import tomllib
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import Any

import cv2
import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.clothes import Outfit, draw_outfit
from nao_sim.people.actors.persons import Person, body_scales
from nao_sim.people.arrays import Array, Image
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.camera import Camera, Light
from nao_sim.people.filming.rooms import BOX, FACING, Item, draw_room
from nao_sim.people.filming.sensor import Exposure, Sensor
from nao_sim.people.filming.shots import cameras, draw_light, generator, weighted
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import hand_postures, joints
from nao_sim.resources import resource

DETAIL = 2.0
HAND_LENGTH = 0.19
# What is seen of a person of whom only the hand is photographed.
_HAND_PARTS = ("hand", "cuff", "lower_sleeve", "watch")


@dataclass(frozen=True)
class Photo:
    """One photo before it is rendered; ``width`` and ``height`` in pixels, ``angles`` (nq,) in rad."""

    label: str
    take: int
    person: Person
    outfit: Outfit
    close: bool
    left: bool
    angles: Array
    room: list[Item]
    light: Light
    sensor: Sensor
    width: int
    height: int
    vignette: float
    seed: int


@lru_cache
def table() -> dict[str, Any]:
    """Return the tables of ``assets/people/photos.toml``."""
    with resource("assets", "people", "photos.toml").open("rb") as file:
        return tomllib.load(file)


def postures() -> list[str]:
    """Names of the static postures."""
    return list(table()["turn"])


def draw_photo(seed: int, label: str, person: Person, take: int) -> Photo:
    """Draw photo ``take`` of ``person`` showing ``label``."""
    rng = generator(seed, label, person.name, take, "photo")
    close = bool(rng.random() < table()["close"]["share"])
    kind = table()["close" if close else "person"]
    width, height, _ = weighted(kind["sizes"], rng)
    left = bool(rng.random() < table()["hand"]["left_share"])
    film = table()["film"]
    lit = {name: value for name, value in cameras()["sensor"].items() if name != "dim"}
    sensor = replace(Sensor.draw(lit | film, rng), flicker=(0.0, 1.0))
    outfit = draw_outfit(rng)
    if close and outfit.sleeves == "long":
        # Cuffs hide the wrist in some photos, not in all.
        outfit = replace(outfit, sleeves=str(rng.choice(["long", "short", "none"])))
    return Photo(
        label=label,
        take=take,
        person=person,
        outfit=outfit,
        close=close,
        left=left,
        angles=_angles(label, person, close, "l_" if left else "r_", rng),
        room=_background(rng) if close else draw_room(rng, float(rng.uniform(0, 1))),
        light=draw_light(rng),
        sensor=sensor,
        width=int(width),
        height=int(height),
        vignette=float(rng.uniform(*film["vignette"])),
        seed=int(rng.integers(2**31)),
    )


def _angles(label: str, person: Person, close: bool, side: str, rng: Generator) -> Array:
    """The forearm upright before the body, the hand turned and bent a little by chance."""
    out = np.zeros(len(joints()))
    hand = table()["hand"]

    def put(name: str, degrees: float) -> None:
        out[joints()[name]] += np.radians(degrees)

    other = "l_" if side == "r_" else "r_"
    put(f"{other}shoulder_abduct", person.left_rest)
    put(f"{other}elbow", 15)
    for joint, angle in hand_postures()["relaxed"].items():
        put(other + joint, angle)
    raised = 40.0 if close else float(rng.uniform(*table()["person"]["reach_deg"]))
    if close or rng.random() < 0.5:
        put(f"{side}shoulder_flex", raised)
        put(f"{side}elbow", 180 - raised + rng.normal(0, 3 if close else 8))
        put(f"{side}pronate", 90)
    else:
        put(f"{side}shoulder_abduct", raised)
        put(f"{side}shoulder_twist", 82)
        put(f"{side}elbow", 178 - raised + rng.normal(0, 8))
        put(f"{side}pronate", 84 - raised)
    put(f"{side}pronate", rng.normal(*table()["turn"][label]))
    put(f"{side}wrist_flex", rng.normal(-4, hand["wrist_jitter"]))
    put(f"{side}wrist_deviate", rng.normal(0, hand["wrist_jitter"]))
    spread = np.exp(rng.normal(0, hand["spread_scale"]))
    for joint, angle in hand_postures()[label].items():
        angle *= spread if "spread" in joint else 1.0
        jitter = hand["spread_jitter"] if "spread" in joint or "abduct" in joint else hand["finger_jitter"]
        # Joints that bend together err together: a finger's dip follows its pip.
        put(side + joint, angle + rng.normal(0, jitter * (0.5 if joint.startswith("thumb") else 1.0)))
    put("head_yaw", rng.normal(0, 8))
    put("head_pitch", rng.normal(4, 6))
    return out


def _background(rng: Generator) -> list[Item]:
    """A sheet behind the hand: light and plain mostly, else any colour and texture."""
    close = table()["close"]
    if rng.random() < close["plain_share"]:
        tone = rng.uniform(*close["paper"])
        r, g, b = np.clip(tone * (1 + rng.normal(0, 0.02, 3)), 0, 1)
        rgb, texture = (float(r), float(g), float(b)), "plain"
    else:
        r, g, b = rng.uniform(0.1, 0.95, 3)
        rgb, texture = (float(r), float(g), float(b)), str(rng.choice(["noise", "planks", "tiles", "books", "curtain"]))
    return [Item(BOX, (-rng.uniform(0.6, 1.5), 0, 1), (4, 4, 0.02), rgb, texture, FACING)]


def take_photo(stage: Stage, photo: Photo) -> Image:
    """Render ``photo``: BGR (height, width, 3)."""
    scale = table()["film"]["supersample"] if photo.width <= 400 else 2
    rng = np.random.default_rng(photo.seed)
    stage.set_size(photo.width * scale, photo.height * scale)
    stage.cast(photo.person, photo.outfit)
    if photo.close:
        stage.show_only(("watch", *_HAND_PARTS) if photo.outfit.watch else _HAND_PARTS[:3])
    stage.furnish(photo.room)
    stage.light(photo.light)
    stage.aim(_close_camera(stage, photo, rng) if photo.close else person_camera(photo, rng))
    stage.room_image()
    picture = stage.image(photo.angles)
    small = cv2.resize(picture, (photo.width, photo.height), interpolation=cv2.INTER_AREA)
    y, x = np.mgrid[-1 : 1 : photo.height * 1j, -1 : 1 : photo.width * 1j]
    shaded = small * (1 - photo.vignette * (x**2 + y**2) / 2)[:, :, None]
    return Exposure(photo.sensor, photo.width, photo.height).develop(shaded.astype(np.uint8), 0.0)


def _close_camera(stage: Stage, photo: Photo, rng: Generator) -> Camera:
    """A camera before the middle of the hand."""
    close, hand = table()["close"], HAND_LENGTH * float(body_scales(photo.person)["r_hand"][2])
    wrist, knuckle = (
        stage.body_position(photo.angles, f"{'l' if photo.left else 'r'}_{b}") for b in ("wrist", "middle_1")
    )
    aspect = photo.width / photo.height
    high = hand * rng.uniform(*close["high"]) * max(1.0, 0.9 / aspect)
    middle = wrist + (knuckle - wrist) * rng.uniform(0.75, 1.15)
    middle[1:] += rng.normal(0, close["off_centre"], 2) * high
    fovy = float(rng.uniform(*close["fovy_deg"]))
    distance = high / 2 / np.tan(np.radians(fovy) / 2)
    up = np.radians(rng.uniform(-1, 1) * close["elevation_deg"])
    pos = middle + distance * np.array([np.cos(up), 0.0, np.sin(up)])
    tilt = float(rng.normal(0, table()["hand"]["tilt"]))
    return Camera((pos[0], pos[1], pos[2]), (middle[0], middle[1], middle[2]), fovy, tilt)


def person_camera(photo: Photo, rng: Generator) -> Camera:
    """A camera that sees head, shoulders and the raised hand."""
    kind, stature = table()["person"], photo.person.stature
    high = stature * rng.uniform(*kind["high"])
    middle = stature * (1 + rng.uniform(*kind["above"])) - high / 2
    aside = (0.12 if photo.left else -0.12) * stature * rng.uniform(0, 1) + rng.normal(0, 0.05)
    fovy = float(rng.uniform(26, 46))
    distance = high / 2 / np.tan(np.radians(fovy) / 2)
    pos = (float(distance), aside + rng.normal(0, 0.15), middle + rng.normal(0, 0.15))
    return Camera(pos, (0.0, aside, middle), fovy, float(rng.normal(0, 2)))


def write_photo(stage: Stage, photo: Photo, path: Path) -> None:
    """Render ``photo`` to ``path`` as JPEG, atomically."""
    image = take_photo(stage, photo)
    path.parent.mkdir(parents=True, exist_ok=True)
    done, jpeg = cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, photo.sensor.quality])
    if not done:
        raise FilmError(f"{path} cannot be encoded; check its size")
    part = path.with_name(f".{path.stem}.{os.getpid()}.part.jpg")
    try:
        part.write_bytes(jpeg.tobytes())
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)
