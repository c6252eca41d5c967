"""Verifying a data set: what is wrong with it, what is in it, and how it looks."""

from __future__ import annotations

import hashlib
from collections import Counter, defaultdict
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import cv2
import numpy as np

from nao_sim.errors import did_you_mean
from nao_sim.people.arrays import Image
from nao_sim.people.datasets.manifest import known_labels

MIN_FRAMES = 8
MIN_SECONDS = 0.6
# One class with this many times the clips of another is worth a word.
UNBALANCED = 3.0


@dataclass(frozen=True)
class Problem:
    """Something wrong: its kind, the file or name concerned, what and how to mend it; a warning does not fail."""

    kind: str
    where: str
    text: str
    warning: bool = False


@dataclass(frozen=True)
class Seen:
    """What reading a clip showed: frames, frames a second, size, and a hash of the file."""

    frames: int
    fps: float
    width: int
    height: int
    digest: str


def inspect(path: Path, thumbs: int = 0) -> tuple[Seen | None, list[Image]]:
    """Read a video or photo to its end: what it is (None when unreadable), and evenly spaced frames of it."""
    if not path.is_file() or path.stat().st_size == 0:
        return None, []
    digest = hashlib.sha256(path.read_bytes()).hexdigest()
    if path.suffix.lower() in (".jpg", ".jpeg", ".png", ".bmp"):
        image = cv2.imread(str(path))
        if image is None:
            return None, []
        return Seen(1, 0.0, image.shape[1], image.shape[0], digest), [np.asarray(image, dtype=np.uint8)] * bool(thumbs)
    video = cv2.VideoCapture(str(path))
    fps, kept, count = float(video.get(cv2.CAP_PROP_FPS) or 0.0), [], 0
    size = (0, 0)
    while True:
        read, frame = video.read()
        if not read:
            break
        size = (frame.shape[1], frame.shape[0])
        if thumbs:
            kept.append(_thumb(np.asarray(frame, dtype=np.uint8)))
        count += 1
    video.release()
    if count == 0:
        return None, []
    chosen = [kept[k] for k in np.linspace(0, count - 1, thumbs).astype(int)] if thumbs else []
    return Seen(count, fps if np.isfinite(fps) else 0.0, *size, digest), chosen


def check(folder: Path, rows: Sequence[dict[str, Any]], done: Callable[[], None] = lambda: None) -> list[Problem]:
    """Read every clip of a data set and list what is wrong.

    Args:
        folder: the data set.
        rows: its manifest.
        done: called after each clip.
    """
    problems: list[Problem] = []
    hashes: dict[tuple[str, int, int], dict[str, Any]] = {}
    for row in rows:
        seen, _ = inspect(folder / row["file"])
        problems += _of_clip(row, seen)
        if seen is not None:
            key = (seen.digest, int(row.get("start") or 0), int(row.get("end") or seen.frames - 1))
            if key in hashes:
                problems.append(_twice(row, hashes[key]))
            hashes.setdefault(key, row)
        done()
    return [*problems, *_of_names(rows), *_of_balance(rows)]


def _of_clip(row: dict[str, Any], seen: Seen | None) -> Iterable[Problem]:
    file, labels = row["file"], known_labels()
    if row["label"] not in labels:
        yield Problem("label", file, f"unknown label '{row['label']}'{did_you_mean(row['label'], labels)}")
    if seen is None:
        yield Problem("unreadable", file, "no frame can be read; is it there, and a video or a photo?")
        return
    first, last = int(row.get("start") or 0), int(row.get("end") or seen.frames - 1)
    if not 0 <= first <= last < seen.frames:
        yield Problem("range", file, f"frames {first} to {last} are not in a clip of {seen.frames}")
        return
    frames = last - first + 1
    if labels.get(row["label"]) != "static":
        seconds = frames / seen.fps if seen.fps > 0 else None
        if frames < MIN_FRAMES or (seconds is not None and seconds < MIN_SECONDS):
            yield Problem("short", file, f"{frames} frames; a gesture needs {MIN_FRAMES} and {MIN_SECONDS} s")
    if "width" in row and (row["width"], row["height"]) != (seen.width, seen.height):
        yield Problem("size", file, f"is {seen.width}x{seen.height}, not {row['width']}x{row['height']} as listed")


def _twice(row: dict[str, Any], other: dict[str, Any]) -> Problem:
    same = f"is the same recording as {other['file']}"
    if row["person"] != other["person"]:
        return Problem("person", row["file"], f"{same}, as '{row['person']}' and as '{other['person']}'")
    return Problem("duplicate", row["file"], f"{same}; remove one")


def _of_names(rows: Sequence[dict[str, Any]]) -> Iterable[Problem]:
    """Persons whose names differ by case, spaces or punctuation only, who would be on both sides of a split."""
    spelt: dict[str, set[str]] = defaultdict(set)
    for row in rows:
        spelt["".join(c for c in str(row["person"]).casefold() if c.isalnum())].add(str(row["person"]))
    for names in spelt.values():
        if len(names) > 1:
            listed = "', '".join(sorted(names))
            yield Problem("person", sorted(names)[0], f"'{listed}' look like one person; use one name")


def _of_balance(rows: Sequence[dict[str, Any]]) -> Iterable[Problem]:
    counts = Counter(row["label"] for row in rows if row["label"] != "irrelevant")
    if counts:
        (most, high), (least, low) = counts.most_common()[0], counts.most_common()[-1]
        if high >= UNBALANCED * low:
            text = f"{most} has {high} clips and {least} has {low}"
            yield Problem("balance", most, f"{text}; record more of the latter", warning=True)
    persons = {row["person"] for row in rows}
    if len(persons) < 2:
        text = "all clips are of one person; without a second nothing can be said about other people"
        yield Problem("balance", next(iter(persons), "?"), text, warning=True)
    alone = [label for label in counts if len({row["person"] for row in rows if row["label"] == label}) == 1]
    if alone and len(persons) > 1:
        text = f"one person alone performs {', '.join(alone)}: the gesture cannot be told from the person"
        yield Problem("balance", alone[0], text, warning=True)


def contact_sheet(folder: Path, rows: Sequence[dict[str, Any]], columns: int = 8) -> Image:
    """A picture with ``columns`` frames of one clip of each label, the label written on the first; BGR."""
    first = {row["label"]: row for row in reversed(rows)}
    lines = []
    for label in sorted(first):
        _, shown = inspect(folder / first[label]["file"], thumbs=columns)
        cells = [_thumb(frame) for frame in shown]
        cells += [np.zeros((90, 120, 3), np.uint8)] * (columns - len(cells))
        line = np.hstack(cells)
        for thickness, colour in ((3, (0, 0, 0)), (1, (255, 255, 255))):
            cv2.putText(line, label, (4, 12), cv2.FONT_HERSHEY_SIMPLEX, 0.38, colour, thickness, cv2.LINE_AA)
        lines.append(line)
    return np.asarray(np.vstack(lines), dtype=np.uint8)


def _thumb(frame: Image, width: int = 120, height: int = 90) -> Image:
    """``frame`` fitted into a cell."""
    scale = min(width / frame.shape[1], height / frame.shape[0])
    small = cv2.resize(
        frame,
        (max(1, round(frame.shape[1] * scale)), max(1, round(frame.shape[0] * scale))),
        interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_NEAREST,
    )
    cell = np.zeros((height, width, 3), np.uint8)
    cell[: small.shape[0], : small.shape[1]] = small
    return cell
