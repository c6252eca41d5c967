"""Film persons who show a hand, with where it is: photos from which a hand in view is learnt to be found and named.

Usage: python tools/film_hands.py FOLDER [--persons 320] [--seed 301] [--vary 1] [--jobs 2]

Every person shows every posture, other hands that are none of them, and nothing at all. `hands.csv` has a row for each
photo: file, label ("irrelevant ..." for other hands, "nothing"), person, x and y of the middle finger's knuckle, length
of the hand, x and y of the top of the neck, in pixels. Train on one seed and report on another.

Real people hold their fingers less exactly than `nao-sim film` shows them: `--vary` bends, spreads and turns them by so
much more (0: not at all).
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import joblib
import numpy as np
from numpy.random import Generator

from nao_sim.people.actors.persons import Person
from nao_sim.people.datasets.dataset import CHILDREN
from nao_sim.people.filming import photos
from nao_sim.people.filming.hand_ground_truth import known_hand
from nao_sim.people.filming.shots import draw_cast, generator
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import hand_postures, joint_ranges, joints, pose, tables

COLUMNS = ("file", "label", "person", "x", "y", "hand", "neck_x", "neck_y")
POSTURE_TAKES, OTHER_TAKES, NOTHING_TAKES = 7, 2, 12  # of each posture, of each other hand, of nothing
SMALLEST = 18  # pixels of a hand's length
FINGER_JITTER = 5.0  # standard deviation, degrees, of the joints of other hands
# Degrees at --vary 1: how far all fingers are slack (evenly between), and the largest standard deviation of the bend of
# each joint, of how fingers are spread, of the thumb and of the hand's turn about the forearm.
SLACK, BEND, SPREAD, THUMB, TURN = (-4.0, 14.0), 8.0, 4.0, 8.0, 8.0
TOUCHING = ("round", "perfect")  # where thumb and finger meet: half as much
# Hands that show none of the postures: each finger as in another posture of the figure. A slack open hand, and a middle
# finger for a forefinger, are left out: real hands that mean a posture look like them.
OTHER_HANDS: dict[str, dict[str, str]] = {
    "fist": {},
    "hold": {"all": "hold"},
    "horns": {"index": "stop_hand", "little": "stop_hand"},
    "love": {"index": "stop_hand", "little": "stop_hand", "thumb": "stop_hand"},
    "thumb_up": {"thumb": "stop_hand"},
    "little": {"little": "stop_hand"},
    "three_fingers": {"all": "four", "little": "fist"},
    "gun": {"all": "pointing", "thumb": "stop_hand"},
    "no_ring": {"all": "four", "ring": "fist"},
    "no_middle": {"all": "four", "middle": "fist"},
    "shaka": {"thumb": "stop_hand", "little": "stop_hand"},
}
# Poses of the motion file whose hands could be taken for a posture are not "nothing".
SHOWN = {"open", "closed_flat", "pointing", "three"}


def other_hand(name: str) -> dict[str, float]:
    """Return joint (without side) -> degrees of one of `OTHER_HANDS`."""
    fingers = OTHER_HANDS[name]
    angles = dict(hand_postures()[fingers.get("all", "fist")])
    for finger, source in fingers.items():
        angles |= {joint: angle for joint, angle in hand_postures()[source].items() if joint.startswith(finger + "_")}
    return angles


def nothing_poses() -> list[str]:
    """Return the poses of the motion file in which no hand shows a posture."""
    hands = {name: {said.get("r_hand"), said.get("l_hand")} for name, said in tables()["pose"].items()}
    return [name for name, shown in hands.items() if not shown & SHOWN]


def held_loosely(photo: photos.Photo, label: str, vary: float, rng: Generator) -> photos.Photo:
    """Return the photo with the shown hand's joints moved by chance, within their ranges."""
    if not vary:
        return photo
    angles, side = photo.angles.copy(), "l_" if photo.left else "r_"
    less = vary * (0.5 if label in TOUCHING else 1.0)
    slack, bend, spread, thumb = rng.uniform(*SLACK), *(rng.uniform(0, most) for most in (BEND, SPREAD, THUMB))
    for joint in hand_postures()["fist"]:
        if joint.startswith("thumb"):
            moved = rng.normal(0, thumb)
        elif joint.endswith("spread"):
            moved = rng.normal(0, spread)
        else:
            moved = slack * (0.5 if joint.endswith("dip") else 1.0) + rng.normal(0, bend)
        angles[joints()[side + joint]] += np.radians(less * moved)
    angles[joints()[f"{side}pronate"]] += np.radians(vary * rng.normal(0, TURN))
    return replace(photo, angles=np.clip(angles, *joint_ranges()))


def person_photos(seed: int, person: Person, vary: float) -> Iterator[tuple[str, photos.Photo]]:
    """Yield the photos of one person with their labels."""
    rng = generator(seed, "hands", person.name, 0, "film")
    postures = photos.postures()
    for label in postures:
        for photo in in_view(seed, label, person, POSTURE_TAKES):
            yield label, held_loosely(photo, label, vary, rng)
    for k, name in enumerate(OTHER_HANDS):
        base = postures[int(rng.integers(len(postures)))]
        for photo in in_view(seed + 1, base, person, OTHER_TAKES, 100 * k):
            angles = photo.angles.copy()
            for joint, angle in other_hand(name).items():
                at = joints()[("l_" if photo.left else "r_") + joint]
                angles[at] = np.radians(angle + rng.normal(0, FINGER_JITTER))
            yield f"irrelevant {name}", held_loosely(replace(photo, angles=angles), name, vary, rng)
    poses = nothing_poses()
    for photo in in_view(seed + 2, postures[0], person, NOTHING_TAKES):
        name, other = (poses[int(rng.integers(len(poses)))] for _ in range(2))
        share = rng.uniform(0, 0.5)
        mirrored = bool(rng.random() < 0.5)
        angles = (1 - share) * pose(name, mirrored).angles + share * pose(other, mirrored).angles
        hands = {side + j: a for side in ("l_", "r_") for j, a in hand_postures()["relaxed"].items()}
        for joint, angle in hands.items():
            if not angles[joints()[joint]]:
                angles[joints()[joint]] = np.radians(angle)
        yield "nothing", replace(photo, angles=angles + rng.normal(0, 0.04, len(angles)) * (angles != 0))


def in_view(seed: int, label: str, person: Person, takes: int, first: int = 0) -> Iterator[photos.Photo]:
    """Yield photos of a person in view; close-ups are drawn too, and left out."""
    take = first
    while takes:
        photo = photos.draw_photo(seed, label, person, take)
        take += 1
        if not photo.close:
            takes -= 1
            yield photo


def film_person(folder: Path, seed: int, persons: int, number: int, vary: float) -> list[tuple[object, ...]]:
    """Render the photos of one person; return their rows."""
    person = draw_cast(seed, persons, CHILDREN)[number]
    rows: list[tuple[object, ...]] = []
    with Stage(photos.DETAIL) as stage:
        for k, (label, photo) in enumerate(person_photos(seed, person, vary)):
            known = known_hand(stage, photo)
            if known.length < SMALLEST:
                continue
            name = f"{number:03d}/{k:03d}.jpg"
            photos.write_photo(stage, photo, folder / name)
            places = [*known.knuckle.round(2), round(known.length, 2), *known.neck.round(2)]
            rows.append((name, label, person.name, *places))
    return rows


def main() -> None:
    """Run from the command line."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path)
    parser.add_argument("--persons", type=int, default=320)
    parser.add_argument("--seed", type=int, default=301)
    parser.add_argument("--vary", type=float, default=1.0, help="how loosely hands are held")
    parser.add_argument("--jobs", type=int, default=2)
    asked = parser.parse_args()
    given = asked.folder, asked.seed, asked.persons
    work = (joblib.delayed(film_person)(*given, k, asked.vary) for k in range(asked.persons))
    done = joblib.Parallel(n_jobs=asked.jobs, return_as="generator")(work)
    asked.folder.mkdir(parents=True, exist_ok=True)
    with (asked.folder / "hands.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(COLUMNS)
        for k, found in enumerate(done):
            rows.writerows(found)
            file.flush()
            print(f"person {k + 1} of {asked.persons}: {len(found)} photos", flush=True)


if __name__ == "__main__":
    main()
