"""Can a classifier name the gesture from what has nothing to do with it? It must not, beyond twice chance.

    python benchmarks/nuisance.py DATASET

It sees the length of the clip, its frame rate and size, how large the person is (framing, stature), and the colours,
brightness and texture of the background, which is the median of the frames over time; never the motion. Persons are
kept apart (GroupKFold). Printed for each group of features alone and for all: balanced accuracy over chance.
"""

from __future__ import annotations

import argparse
import csv
from pathlib import Path

import cv2
import numpy as np
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import balanced_accuracy_score
from sklearn.model_selection import GroupKFold, cross_val_predict

FRAMINGS = ("whole", "half", "close")


def background(path: Path) -> list[float]:
    """Mean, deviation and edge strength of each channel of the median frame, and its brightness histogram."""
    video, shown = cv2.VideoCapture(str(path)), []
    while True:
        read, frame = video.read()
        if not read:
            break
        shown.append(cv2.resize(frame, (80, 60), interpolation=cv2.INTER_AREA))
    middle = np.median(np.array(shown[:: max(1, len(shown) // 15)]), axis=0).astype(np.float32)
    edges = np.abs(np.diff(middle, axis=1)).mean(axis=(0, 1))
    histogram = np.histogram(middle.mean(axis=2), bins=8, range=(0, 256), density=True)[0]
    return [*middle.mean(axis=(0, 1)), *middle.std(axis=(0, 1)), *edges, *histogram]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    folder = parser.parse_args().dataset
    with (folder / "manifest.csv").open(newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(file) if row["label"] != "irrelevant"]
    labels, persons = np.array([r["label"] for r in rows]), np.array([r["person"] for r in rows])
    frames, fps = np.array([float(r["frames"]) for r in rows]), np.array([float(r["fps"]) for r in rows])
    groups = {
        "length": np.stack([frames, frames / fps], axis=1),
        "rate and size": np.stack([fps, *(np.array([float(r[k]) for r in rows]) for k in ("width", "height"))], axis=1),
        "person size": np.array([[FRAMINGS.index(r["framing"]), float(r["stature"])] for r in rows]),
        "background": np.array([background(folder / r["file"]) for r in rows]),
    }
    groups["all"] = np.concatenate(list(groups.values()), axis=1)
    chance = 1 / len(set(labels))
    print(f"{len(rows)} clips, {len(set(persons))} persons, {len(set(labels))} classes, chance {chance:.3f}")
    for name, features in groups.items():
        forest = RandomForestClassifier(300, min_samples_leaf=3, random_state=0)
        told = cross_val_predict(forest, features, labels, groups=persons, cv=GroupKFold(5))
        score = balanced_accuracy_score(labels, told)
        print(f"{name:14s} balanced accuracy {score:.3f} = {score / chance:.2f} x chance")


if __name__ == "__main__":
    main()
