"""How the template of `hand_finder` is learnt from photos of persons with known hands.

It is a weighted sum, some minutes on a laptop: any raised hand against what is mistaken for one.
"""

from __future__ import annotations

import csv
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from recognizer.person.head_shoulders import Body
from recognizer.person.training.finder_training import Weights, balanced_ridge
from recognizer.postures.person import windows
from recognizer.postures.person.hand_finder import HAND, REACH, face_colour, find_heads, search
from recognizer.postures.photo import read_photo
from recognizer.postures.types import Floats, Image

RIDGE = 300.0
ROUNDS = 2  # of adding what is mistaken for a hand, each from half of the photos
RANDOM_PLACES, HARD_PLACES = 6, 6  # of no hand in a photo
NOTHING = "nothing"  # label of a photo in which no hand is shown


@dataclass(frozen=True)
class KnownHand:
    """Truth for one photo, in pixels of it.

    Attributes:
        path: the photo.
        label: the posture; other hands begin with "irrelevant", and `NOTHING` shows none.
        person: who it is.
        middle: (2,) x, y of the middle finger's knuckle.
        hand: length of the hand, wrist to fingertips.
        neck: (2,) x, y of the top of the neck.
    """

    path: Path
    label: str
    person: str
    middle: Floats
    hand: float
    neck: Floats


@dataclass(frozen=True)
class Seen:
    """A photo with the head that was found in it."""

    known: KnownHand
    head: Body

    def picture(self) -> Image:
        """Return the photo, (h, w, 3) uint8 BGR."""
        return read_photo(self.known.path)

    def away(self, x: float, y: float) -> float:
        """Return how far a place is from the hand, hand lengths."""
        return float(np.hypot(x - self.known.middle[0], y - self.known.middle[1])) / self.known.hand


def read_hands(folder: Path) -> list[KnownHand]:
    """Return the photos of a folder with a ``hands.csv`` as ``tools/film_hands.py`` writes it."""
    with (folder / "hands.csv").open() as file:
        return [
            KnownHand(
                folder / row["file"],
                row["label"],
                row["person"],
                np.array([float(row["x"]), float(row["y"])]),
                float(row["hand"]),
                np.array([float(row["neck_x"]), float(row["neck_y"])]),
            )
            for row in csv.DictReader(file)
        ]


def train(hands: Sequence[KnownHand], out: Path, seed: int = 0, tell: Callable[[str], None] = print) -> None:
    """Learn the template and write its file.

    Args:
        hands: photos with known hands, of many persons and rooms.
        out: the .npz file to write.
        seed: of random places and jitter.
        tell: called with a line of progress.
    """
    rng = np.random.default_rng(seed)
    seen = [found for known in hands if (found := with_head(known)) is not None]
    tell(f"{len(seen)} of {len(hands)} heads found")
    learnt = _learn([s for s in seen if s.known.label != NOTHING], rng, tell)
    np.savez_compressed(out, weights=_template(learnt).astype(np.float16), offset=np.float32(learnt[1]))


def with_head(known: KnownHand) -> Seen | None:
    """Return the photo with its head, if it is among the places that are tried when a photo is recognised."""
    for head in find_heads(read_photo(known.path)):
        near = np.hypot(head.x - known.neck[0], head.y - known.neck[1]) < 0.75 * head.head
        if near and 0.75 < 0.95 * head.head / known.hand < 1.45:
            return Seen(known, head)
    return None


def _learn(seen: list[Seen], rng: np.random.Generator, tell: Callable[[str], None]) -> Weights:
    hands: list[np.ndarray] = []
    others: list[np.ndarray] = []
    for s in seen:
        picture = s.picture()
        face, known = face_colour(picture, s.head), s.known
        for _ in range(2):
            middle = known.middle + rng.normal(0, 0.04, 2) * known.hand
            size, turn = known.hand * np.exp(rng.normal(0, 0.08)), rng.normal(0, 0.12)
            hands.append(windows.window_vector(picture, middle, size, face, turn))
        size = HAND * s.head.head * np.exp(rng.normal(0, 0.1))
        others += [windows.window_vector(picture, place, size, face) for place in _elsewhere(s, picture, rng)]
    weights = _ridge(hands, others)
    for turn_number in range(ROUNDS):
        first = []
        for s in seen[turn_number::ROUNDS]:
            picture = s.picture()
            spots = search(picture, s.head, _template(weights), weights[1])
            first.append(bool(spots) and s.away(spots[0].x, spots[0].y) < 0.25)
            mistaken = [spot for spot in spots[:HARD_PLACES] if s.away(spot.x, spot.y) > 0.4]
            others += [windows.window_vector(picture, m.middle, m.hand, m.face) for m in mistaken]
        tell(f"round {turn_number + 1}: the hand is the first of its photo in {np.mean(first):.3f}")
        weights = _ridge(hands, others)
    return weights


def _elsewhere(s: Seen, picture: Image, rng: np.random.Generator) -> list[Floats]:
    """Return random places (2,) within reach that are no hand."""
    head = s.head
    low = [head.x - REACH[0] * head.head, head.y - REACH[1] * head.head]
    high = [head.x + REACH[0] * head.head, head.y + REACH[2] * head.head]
    drawn = rng.uniform(low, high, (4 * RANDOM_PLACES, 2))
    inside = (drawn > 0).all(axis=1) & (drawn < picture.shape[1::-1]).all(axis=1)
    return [place for place in drawn[inside] if s.away(*place) > 0.4][:RANDOM_PLACES]


def _ridge(hands: list[np.ndarray], others: list[np.ndarray]) -> Weights:
    return balanced_ridge(np.array(hands + others), np.arange(len(hands) + len(others)) < len(hands), RIDGE)


def _template(weights: Weights) -> np.ndarray:
    shape = (windows.CELLS, windows.CELLS, windows.CHANNELS)
    return weights[0].reshape(shape).astype(np.float32)
