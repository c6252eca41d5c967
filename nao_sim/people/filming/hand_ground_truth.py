"""Where the hand that a photo is about stands in its picture, from the figure's joints."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from nao_sim.people.actors.persons import body_scales
from nao_sim.people.arrays import Array
from nao_sim.people.filming.photos import HAND_LENGTH, Photo, person_camera
from nao_sim.people.filming.stage import Stage


class KnownHand(NamedTuple):
    """What a photo of a person shows, in its pixels.

    Attributes:
        knuckle: (2,) x, y of the middle finger's knuckle.
        length: of the hand, wrist to fingertips, as if it faced the camera.
        neck: (2,) x, y of the top of the neck.
    """

    knuckle: Array
    length: float
    neck: Array


def known_hand(stage: Stage, photo: Photo) -> KnownHand:
    """Return where the raised hand of a photo is; the photo is of a person (``photo.close`` is false)."""
    stage.cast(photo.person, photo.outfit)
    camera = person_camera(photo, np.random.default_rng(photo.seed))
    side = "l" if photo.left else "r"
    wrist, knuckle, neck = (
        stage.body_position(photo.angles, joint) for joint in (f"{side}_wrist", f"{side}_middle_1", "head")
    )
    forward = np.subtract(camera.aim, camera.pos)
    depth = float((wrist - camera.pos) @ (forward / np.linalg.norm(forward)))
    length = HAND_LENGTH * float(body_scales(photo.person)["r_hand"][2])
    # Camera.project counts in half heights of the picture, up.
    middle = np.array([photo.width, photo.height]) / 2
    places = camera.project(np.array([knuckle, neck])) * [1, -1] * photo.height / 2 + middle
    focal = photo.height / 2 / np.tan(np.radians(camera.fovy_deg) / 2)
    return KnownHand(places[0], length * focal / depth, places[1])
