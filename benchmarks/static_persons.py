"""Measure the posture recogniser on rendered photos of a person with face, arm and hand in view, by size of the hand.

Usage: python benchmarks/static_persons.py [FOLDER] [--persons even|odd] [--every N]

FOLDER is what tools/film_hands.py filmed with a seed of its own (`--persons 20 --seed 402`); other hands and photos in
which nothing is shown are reported apart. Without it persons are filmed as `nao-sim film` films them: what was chosen
by looking at such photos was chosen on persons with odd numbers, and even ones are reported.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from pathlib import Path

import cv2
import numpy as np

from nao_sim.people.datasets.dataset import plan
from nao_sim.people.filming import photos
from nao_sim.people.filming.hand_ground_truth import known_hand
from nao_sim.people.filming.stage import Stage
from recognizer.postures import PhotoRecognizer
from recognizer.postures.errors import PhotoError
from recognizer.postures.person.training.hand_finder_training import read_hands
from recognizer.postures.photo import read_photo

PERSONS, TAKES, SEED = 40, 6, 3
SIZES = ((18, 24), (24, 30), (30, 36), (36, 44), (44, 60), (60, 200))  # length of a hand, pixels
Shown = tuple[str, float, np.ndarray]  # label, length of the hand, photo


def filmed(odd: bool) -> Iterator[Shown]:
    """Film persons with even or odd numbers, the photos stored and read again as those of a data set are."""
    with Stage(photos.DETAIL) as stage:
        for job in plan(PERSONS, TAKES, SEED, photos.postures()):
            photo = job.photo()
            if job.person % 2 != odd or photo.close:
                continue
            length = known_hand(stage, photo).length
            picture = photos.take_photo(stage, photo)
            _, jpeg = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, photo.sensor.quality])
            yield photo.label, length, cv2.imdecode(jpeg, cv2.IMREAD_COLOR)


def stored(folder: Path) -> Iterator[Shown]:
    """Read a folder."""
    for known in read_hands(folder):
        yield known.label, known.hand, read_photo(known.path)


def name(recognizer: PhotoRecognizer, picture: np.ndarray) -> str | None:
    """Return the posture that is named, if any."""
    try:
        return recognizer.recognize(picture).label
    except PhotoError:
        return None


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("folder", type=Path, nargs="?")
    parser.add_argument("--persons", choices=("even", "odd"), default="even")
    parser.add_argument("--every", type=int, default=1, help="only every n-th photo")
    parser.add_argument("--database", type=Path, default=Path("assets/databases/static.parquet"))
    asked = parser.parse_args()
    recognizer = PhotoRecognizer.load(asked.database)
    shown = stored(asked.folder) if asked.folder else filmed(asked.persons == "odd")
    rows = []
    others: dict[str, list[bool]] = {}
    for number, (label, length, picture) in enumerate(shown):
        if number % asked.every:
            continue
        said = name(recognizer, picture)
        if label in recognizer.labels:
            rows.append((length, said == label, said not in (None, label)))
        else:
            others.setdefault(label, []).append(said is not None)
    found = np.array(rows, float)
    print("hand [px]   photos  right  wrong  rejected")
    for low, high in (*SIZES, (SIZES[0][0], SIZES[-1][1])):
        chosen = found[(found[:, 0] >= low) & (found[:, 0] < high)]
        if len(chosen):
            right, wrong = chosen[:, 1:].mean(axis=0)
            print(f"{low:3d} to {high:3d}  {len(chosen):6d}  {right:.3f}  {wrong:.3f}  {1 - right - wrong:.3f}")
    for label, named in sorted(others.items()):
        print(f"{label}: {sum(named)} of {len(named)} named as a posture")


if __name__ == "__main__":
    main()
