"""Measure the posture recogniser on rendered photos of a person with face, arm and hand in view, by size of the hand.

Usage: python benchmarks/static_persons.py [--persons even|odd] [--every N]

What was chosen by looking at such photos was chosen on persons with odd numbers; even ones are reported.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import numpy as np

from nao_sim.people import photos
from nao_sim.people.dataset import plan
from nao_sim.people.persons import body_scales
from nao_sim.people.stage import Stage
from recognizer.static import PhotoRecognizer
from recognizer.static.errors import PhotoError

PERSONS, TAKES, SEED = 40, 6, 3
SIZES = ((30, 36), (36, 44), (44, 60), (60, 100))  # length of a hand, pixels


def hand_length(photo: photos.Photo, stage: Stage) -> float:
    """Return the hand's length from wrist to fingertips as the camera sees it, pixels."""
    stage.cast(photo.person, photo.outfit)
    camera = photos._person_camera(photo, np.random.default_rng(photo.seed))
    wrist = stage.body_position(photo.angles, "l_wrist" if photo.left else "r_wrist")
    forward = np.subtract(camera.aim, camera.pos)
    depth = float((wrist - camera.pos) @ (forward / np.linalg.norm(forward)))
    focal = photo.height / 2 / np.tan(np.radians(camera.fovy_deg) / 2)
    return photos.HAND_LENGTH * float(body_scales(photo.person)["r_hand"][2]) * focal / depth


def answers(recognizer: PhotoRecognizer, odd: bool, every: int) -> np.ndarray:
    """Return (n, 3): length of the hand, right, wrong (neither: rejected)."""
    jobs = [job for job in plan(PERSONS, TAKES, SEED, photos.postures()) if job.person % 2 == odd]
    rows = []
    with Stage(photos.DETAIL) as stage:
        for job in jobs[::every]:
            photo = job.photo()
            if photo.close or (length := hand_length(photo, stage)) < SIZES[0][0]:
                continue
            # As a data set stores it.
            picture = photos.take_photo(stage, photo)
            _, jpeg = cv2.imencode(".jpg", picture, [cv2.IMWRITE_JPEG_QUALITY, photo.sensor.quality])
            try:
                label = recognizer.recognize(cv2.imdecode(jpeg, cv2.IMREAD_COLOR)).label
            except PhotoError:
                label = None
            rows.append((length, label == photo.label, label not in (None, photo.label)))
    return np.array(rows, float)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--persons", choices=("even", "odd"), default="even")
    parser.add_argument("--every", type=int, default=1, help="only every n-th photo")
    parser.add_argument("--database", type=Path, default=Path("assets/databases/static.parquet"))
    arguments = parser.parse_args()
    rows = answers(PhotoRecognizer.load(arguments.database), arguments.persons == "odd", arguments.every)
    print("hand [px]   photos  right  wrong  rejected")
    for low, high in (*SIZES, (36, 100)):
        chosen = rows[(rows[:, 0] >= low) & (rows[:, 0] < high)]
        if len(chosen):
            right, wrong = chosen[:, 1:].mean(axis=0)
            print(f"{low:3d} to {high:3d}  {len(chosen):6d}  {right:.2f}   {wrong:.2f}   {1 - right - wrong:.2f}")


if __name__ == "__main__":
    main()
