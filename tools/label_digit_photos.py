"""Lay out the photos of Sign Language Digits as ``docs/recordings.md`` has them.

    python tools/label_digit_photos.py Sign-Language-Digits-Dataset/Dataset RECORDINGS/static

The data set says which digit a photo shows, not who shows it. Photos were numbered as they were taken, each person from
0 to 9, so a digit that is no larger than the one before it begins another person.
"""

from __future__ import annotations

import argparse
import csv
import re
import shutil
from pathlib import Path

# The photos that our figures are of; the data set has others of other persons.
FIRST, LAST = 1118, 4915


def main() -> None:
    """Copy the photos and write ``labels.csv``."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path, help="folder with a folder for each digit")
    parser.add_argument("out", type=Path)
    asked = parser.parse_args()
    numbered = {}
    for path in asked.dataset.glob("[0-9]/IMG_*.JPG"):
        number = re.fullmatch(r"IMG_(\d+)\.JPG", path.name)
        if number and FIRST <= int(number[1]) <= LAST:
            numbered[int(number[1])] = path
    if not numbered:
        parser.error(f"{asked.dataset} has no photos such as 0/IMG_{FIRST}.JPG")
    rows, person, before = [], -1, 10
    for _, path in sorted(numbered.items()):
        digit = int(path.parent.name)
        person += digit <= before
        before = digit
        rows.append((f"digit{digit}/p{person:03d}_{path.name}", digit, f"p{person:03d}"))
        (asked.out / rows[-1][0]).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, asked.out / rows[-1][0])
    with (asked.out / "labels.csv").open("w", newline="", encoding="utf-8") as file:
        csv.writer(file).writerows([("file", "digit", "person"), *sorted(rows)])
    print(f"{len(rows)} photos of {person + 1} persons")


if __name__ == "__main__":
    main()
