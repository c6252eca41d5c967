"""Render models/person/person.jpg: persons of a cast side by side, and the seven hand postures.

python tools/render_people.py
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np

from nao_sim.people.actors.clothes import draw_outfit
from nao_sim.people.actors.persons import Person
from nao_sim.people.filming.camera import Camera, Light
from nao_sim.people.filming.photos import DETAIL, draw_photo, postures, take_photo
from nao_sim.people.filming.rooms import BOX, FACING, Item
from nao_sim.people.filming.shots import draw_cast
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import hand_postures, joints

FLOOR = Item(BOX, (0.0, 0.0, -0.1), (6.0, 6.0, 0.1), (0.62, 0.62, 0.6))
WALL = Item(BOX, (-1.2, 0.0, 1.0), (6.0, 6.0, 0.02), (0.86, 0.88, 0.9), "plain", FACING)
LIGHT = Light((-1, -0.5, -0.9), (0.5, 0.5, 0.48), (-1, 0.8, -0.2), (0.15, 0.15, 0.17), (0.4, 0.4, 0.4))
OUT = Path(__file__).resolve().parent.parent / "models" / "person" / "person.jpg"


def standing(person: Person) -> np.ndarray:
    """Angles (nq,) of a person at rest."""
    angles = np.zeros(len(joints()))
    for side in ("r_", "l_"):
        angles[joints()[f"{side}shoulder_abduct"]] = np.radians(person.right_rest)
        angles[joints()[f"{side}elbow"]] = np.radians(15)
        for joint, degrees in hand_postures()["relaxed"].items():
            angles[joints()[side + joint]] = np.radians(degrees)
    return angles


def main() -> None:
    """Render the picture."""
    cast = draw_cast(11, 8)
    with Stage(DETAIL) as stage:
        stage.furnish([FLOOR, WALL])
        stage.light(LIGHT)
        stage.set_size(480, 960)
        stage.aim(Camera((6.0, 0.0, 1.1), (0.0, 0.0, 1.0), 20.0))
        people = []
        for k, person in enumerate(cast):
            stage.cast(person, draw_outfit(np.random.default_rng([11, k])))
            stage.room_image()
            people.append(cv2.resize(stage.image(standing(person)), (140, 280), interpolation=cv2.INTER_AREA))
        hands = []
        for k, label in enumerate(postures()):
            photo = next(
                p for p in (draw_photo(11, label, cast[k], take) for take in range(99)) if p.close and not p.left
            )
            sensor = replace(photo.sensor, noise=0.0, gain=np.ones(3), gamma=1.0, drift=np.zeros((1, 3)), blur=0.0)
            photo = replace(photo, sensor=sensor, light=LIGHT, room=[WALL], width=160, height=160, vignette=0.0)
            hands.append(take_photo(stage, photo))
    row = np.hstack(hands)
    line = cv2.cvtColor(np.hstack(people), cv2.COLOR_RGB2BGR)
    cv2.imwrite(
        str(OUT),
        np.vstack([line, cv2.resize(row, (line.shape[1], round(row.shape[0] * line.shape[1] / row.shape[1])))]),
    )


if __name__ == "__main__":
    main()
