"""How well does a database name the clips of a data set that had no part in it?

Usage: python benchmarks/unseen_persons.py SET [--database FILE]

SET is a folder with a manifest, of other persons than the database's: filmed with another seed, or imported.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import joblib
import numpy as np

from nao_sim.resources import resource
from recognizer import Recognizer, open_clip
from recognizer.evaluation.cross_validation import Evaluation
from recognizer.evaluation.dataset import Entry, read_manifest
from recognizer.learning.database import IRRELEVANT

PART = 50  # clips that one process answers with one loaded database


def answers(database: Path, entries: list[Entry]) -> list[tuple[str, str, bool]]:
    """Nearest gesture, its family, and whether it was rejected, of each clip."""
    cv2.setNumThreads(1)
    recognizer = Recognizer.load(database)
    found = [recognizer.recognize(open_clip(entry.path, entry.frames)) for entry in entries]
    return [(answer.nearest, answer.family, answer.rejected) for answer in found]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("set", type=Path)
    parser.add_argument("--database", type=Path, default=resource("assets", "databases", "dynamic.parquet"))
    asked = parser.parse_args()
    entries = read_manifest(asked.set)
    parts = [entries[first : first + PART] for first in range(0, len(entries), PART)]
    pool = joblib.Parallel(n_jobs=-1, verbose=5)
    rows = [row for part in pool(joblib.delayed(answers)(asked.database, part) for part in parts) for row in part]
    nearest, routed, rejected = (np.array(column) for column in zip(*rows, strict=True))
    known = Recognizer.load(asked.database).database
    family = dict(zip(known.labels.tolist(), known.families.tolist(), strict=True))
    labels = np.array([entry.label for entry in entries])
    evaluation = Evaluation(
        known.method,
        "unseen persons",
        labels,
        np.array([family.get(label, IRRELEVANT) for label in labels.tolist()]),
        nearest,
        routed,
        rejected,
        np.array([entry.person for entry in entries]),
        np.array([entry.name for entry in entries]),
        np.array([entry.action for entry in entries]),
        {},
    )
    print(f"{len(entries)} clips of {len(set(evaluation.persons.tolist()))} persons")
    for name, share in evaluation.summary().items():
        print(f"{name:22s} {share:.3f}")


if __name__ == "__main__":
    main()
