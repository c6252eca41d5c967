"""Film persons showing hands, with known places, and learn the windows that find and name a hand of a person in view.

Usage: python benchmarks/static_learn_persons.py FOLDER [--film] [--out recognizer/static/hand_windows.npz]

With --film the folder is filled first (some 5,000 photos; seeds are those of no reported person). Otherwise it holds
photos and a `hands.csv`: file, label, x and y of the middle finger's knuckle, length of the hand, x and y of the top
of the neck, in pixels. Photos labelled by hand serve as well.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import numpy as np

from nao_sim.people import photos
from nao_sim.people.dataset import plan
from nao_sim.people.persons import body_scales
from nao_sim.people.stage import Stage
from recognizer.static.window_training import KnownHand, train

COLUMNS = ("file", "label", "x", "y", "hand", "neck_x", "neck_y")
TAKES = ((101, 80, 5), (103, 80, 4))  # seed, persons, takes of each posture
OTHERS = (202, 60, 1)
SMALLEST = 30  # pixels of a hand's length
# Hands that show none of the postures: each finger as in another posture of the figure.
OTHER_HANDS: dict[str, dict[str, str]] = {
    "fist": {},
    "hold": {"all": "hold"},
    "relaxed": {"all": "relaxed"},
    "horns": {"index": "stop_hand", "little": "stop_hand"},
    "thumb_up": {"thumb": "stop_hand"},
    "little": {"little": "stop_hand"},
    "three_fingers": {"all": "four", "little": "fist"},
    "gun": {"all": "pointing", "thumb": "stop_hand"},
    "no_ring": {"all": "four", "ring": "fist"},
    "no_middle": {"all": "four", "middle": "fist"},
    "shaka": {"thumb": "stop_hand", "little": "stop_hand"},
}


def other_hands() -> dict[str, dict[str, float]]:
    """Return joint angles, degrees, of the hands that are none of the postures."""
    known = photos.hand_postures()
    made = {}
    for name, fingers in OTHER_HANDS.items():
        angles = dict(known[fingers.get("all", "fist")])
        for finger, source in fingers.items():
            angles |= {joint: angle for joint, angle in known[source].items() if joint.startswith(finger + "_")}
        made[name] = angles
    return made


def film(folder: Path) -> None:
    """Render the photos and write `hands.csv`."""
    folder.mkdir(parents=True, exist_ok=True)
    photos.table()["close"]["share"] = -1.0  # nobody in close-up
    with (folder / "hands.csv").open("w", newline="") as file, Stage(photos.DETAIL) as stage:
        rows = csv.writer(file)
        rows.writerow(COLUMNS)
        for seed, persons, takes in TAKES:
            for job in plan(persons, takes, seed, photos.postures()):
                take(stage, job.photo(), folder, f"{seed}_{job.file}", "", rows)
        made = other_hands()
        photos.hand_postures = lambda: made
        photos.table()["turn"].clear()
        photos.table()["turn"].update({name: [-6, 16] for name in made})
        seed, persons, takes = OTHERS
        for job in plan(persons, takes, seed, photos.postures()):
            take(stage, job.photo(), folder, f"{seed}_{job.label}/p{job.person:03d}.jpg", "irrelevant ", rows)


def take(stage: Stage, photo: photos.Photo, folder: Path, name: str, prefix: str, rows: csv._writer) -> None:
    """Render one photo if its hand is large enough, and note where the hand is."""
    stage.cast(photo.person, photo.outfit)
    camera = photos._person_camera(photo, np.random.default_rng(photo.seed))
    side = "l" if photo.left else "r"
    joints = (f"{side}_wrist", f"{side}_middle_1", "head")
    wrist, knuckle, neck = (stage.body_position(photo.angles, joint) for joint in joints)
    forward = np.subtract(camera.aim, camera.pos)
    depth = float((wrist - camera.pos) @ (forward / np.linalg.norm(forward)))
    focal = photo.height / 2 / np.tan(np.radians(camera.fovy_deg) / 2)
    hand = photos.HAND_LENGTH * float(body_scales(photo.person)["r_hand"][2]) * focal / depth
    if hand < SMALLEST:
        return
    photos.write_photo(stage, photo, folder / name)
    middle = np.array([photo.width, photo.height]) / 2
    places = (camera.project(np.array([knuckle, neck])) * [1, -1] * photo.height / 2 + middle).round(2)
    rows.writerow([name, prefix + photo.label, *places[0], round(hand, 2), *places[1]])


def read(folder: Path) -> list[KnownHand]:
    """Return the photos of a folder."""
    with (folder / "hands.csv").open() as file:
        return [
            KnownHand(
                folder / row["file"],
                row["label"],
                np.array([float(row["x"]), float(row["y"])]),
                float(row["hand"]),
                np.array([float(row["neck_x"]), float(row["neck_y"])]),
            )
            for row in csv.DictReader(file)
        ]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--film", action="store_true")
    parser.add_argument("--out", type=Path, default=Path("recognizer/static/hand_windows.npz"))
    arguments = parser.parse_args()
    if arguments.film:
        film(arguments.folder)
    train(read(arguments.folder), arguments.out)


if __name__ == "__main__":
    main()
