"""Measure the posture recogniser on real photos: person-disjoint, and learnt from hands that nobody filmed.

Usage: python benchmarks/static_postures.py [--recordings FOLDER] [--database assets/databases/static.parquet]

The photos are not part of the project: see docs/recordings.md. Only persons with an odd number are reported in the
second part: what was chosen by looking at photos was chosen on the even ones.
"""

from __future__ import annotations

import argparse
import contextlib
import csv
from pathlib import Path

import numpy as np
from recordings import add_option, recorded

from recognizer.evaluation.dataset import Entry
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.postures import PhotoRecognizer, learn_from_photos
from recognizer.postures.errors import PhotoError
from recognizer.postures.evaluation import Score, on_photos, on_unknown_persons
from recognizer.postures.person.posture_shares import NO_HAND, of_object
from recognizer.postures.photo import read_photo

DIGITS = {
    "0": "round",
    "1": "pointing",
    "2": "victory",
    "3": "three",
    "4": "four",
    "5": "stop_hand",
    "9": "perfect",
}


def read_entries(folder: Path) -> list[Entry]:
    """Return the labelled photos; digits 6, 7 and 8 are none of the vocabulary's postures."""
    rows = csv.DictReader((folder / "labels.csv").read_text().splitlines())
    return [
        Entry(
            folder / row["file"],
            row["file"],
            DIGITS.get(row["digit"], IRRELEVANT),
            DIGITS.get(row["digit"], f"digit {row['digit']}"),
            row["person"],
        )
        for row in rows
    ]


def report(title: str, score: Score) -> None:
    print(f"{title}: right {score.accuracy:.3f}, best guess {score.accuracy_without_threshold:.3f}", end="")
    print(f", others rejected {score.rejected:.3f}" if IRRELEVANT in score.truth else "")
    labels, counts = score.confusion()
    for label, row in zip(labels, counts, strict=True):
        if row.sum():
            print(f"  {label:11s}", *(f"{n:4d}" for n in row))


def network(recognizer: PhotoRecognizer, entries: list[Entry]) -> None:
    """Report the network that names hands of a person in view, asked where the outlines say the hand is."""
    named: list[tuple[bool, bool, str]] = []
    for entry in entries:
        with contextlib.suppress(PhotoError):
            best = recognizer.look(read_photo(entry.path))[0].candidate
            shares = of_object(best.image, best.frame)
            winner = max(shares, key=lambda label: shares[label])
            named.append((entry.label == IRRELEVANT, winner == entry.label, winner))
    postures = [(right, winner) for other, right, winner in named if not other]
    others = [winner for other, _, winner in named if other]
    none = sum(winner == NO_HAND for *_, winner in named)
    print(
        f"the network, {len(named)} of the same photos: right {np.mean([right for right, _ in postures]):.3f}", end=""
    )
    wrong = np.mean([not right and winner in recognizer.labels for right, winner in postures])
    rejected = np.mean([winner not in recognizer.labels for winner in others])
    print(f", another posture {wrong:.3f}, others rejected {rejected:.3f}; {none} taken for no hand")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    add_option(parser)
    parser.add_argument("--database", type=Path, default=Path("assets/databases/static.parquet"))
    arguments = parser.parse_args()
    [labels] = recorded(parser, arguments.recordings, "static/labels.csv")
    entries = read_entries(labels.parent)
    known = [entry for entry in entries if entry.label != IRRELEVANT]
    for method in ("thesis_static", "static"):
        report(f"{method}, 7 classes, unknown persons", on_unknown_persons(learn_from_photos(known, method)))
    odd = [entry for entry in entries if int(entry.person[1:]) % 2]
    recognizer = PhotoRecognizer(Database.load(arguments.database))
    report("shipped database, real photos of odd persons", on_photos(recognizer, odd))
    network(recognizer, odd)
    only = recognizer.database.take(recognizer.database.labels != IRRELEVANT)
    report("the same without irrelevant hands in the database", on_photos(PhotoRecognizer(only), odd))


if __name__ == "__main__":
    main()
