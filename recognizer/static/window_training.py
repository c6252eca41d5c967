"""How the windows of `hand_finder` and `person_postures` are learnt from photos of persons with known hands.

Two linear steps, some minutes on a laptop: a coarse template of any raised hand against what it mistakes for one, and
a shrinkage LDA of fine windows that names the posture, other hands and places that are no hand.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from sklearn.decomposition import PCA
from sklearn.discriminant_analysis import LinearDiscriminantAnalysis

from recognizer.finder import Body
from recognizer.finder_training import Weights, balanced_ridge
from recognizer.static import windows
from recognizer.static.hand_finder import HAND, REACH, face_colour, find_heads, search
from recognizer.static.photo import read_photo
from recognizer.static.types import Floats, Image

COARSE_RIDGE = 300.0
ROUNDS = 2  # of adding what is mistaken for a hand, each from half of the photos
RANDOM_PLACES, HARD_PLACES = 6, 6  # of no hand in a photo
NO_HAND = "no hand"
COMPONENTS, SHRINKAGE = 1200, 0.05
JITTER = (0.05, 0.09, 0.15)  # standard deviations of place [hands], size [logarithm] and turn [rad]


@dataclass(frozen=True)
class KnownHand:
    """Truth for one photo, in pixels of it.

    Attributes:
        path: the photo.
        label: the posture; other hands begin with "irrelevant".
        middle: (2,) x, y of the middle finger's knuckle.
        hand: length of the hand, wrist to fingertips.
        neck: (2,) x, y of the top of the neck.
    """

    path: Path
    label: str
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


def train(hands: Sequence[KnownHand], out: Path, seed: int = 0, tell: Callable[[str], None] = print) -> None:
    """Learn both steps and write the weights file.

    Args:
        hands: photos with known hands, of many persons and rooms.
        out: the .npz file to write.
        seed: of random places and jitter.
        tell: called with a line of progress.
    """
    rng = np.random.default_rng(seed)
    seen = [found for known in hands if (found := _with_head(known)) is not None]
    tell(f"{len(seen)} of {len(hands)} heads found")
    coarse = _coarse([s for s in seen if not s.known.label.startswith("irrelevant")], rng, tell)
    vectors, labels = _fine_windows(seen, coarse, rng)
    tell(f"{len(labels)} fine windows")
    fine, offsets, classes = discriminant(vectors, labels)
    template = coarse[0].reshape(windows.COARSE, windows.COARSE, windows.CHANNELS)
    np.savez_compressed(
        out,
        coarse_weights=template.astype(np.float16), coarse_offset=np.float32(coarse[1]),
        fine_weights=fine.astype(np.float16), fine_offsets=offsets.astype(np.float32), classes=classes,
    )  # fmt: skip


def _with_head(known: KnownHand) -> Seen | None:
    """Return the photo with its head, if it is among the places that are tried when a photo is recognised."""
    for head in find_heads(read_photo(known.path)):
        near = np.hypot(head.x - known.neck[0], head.y - known.neck[1]) < 0.75 * head.head
        if near and 0.75 < 0.95 * head.head / known.hand < 1.45:
            return Seen(known, head)
    return None


def _coarse(seen: list[Seen], rng: np.random.Generator, tell: Callable[[str], None]) -> Weights:
    hands: list[np.ndarray] = []
    others: list[np.ndarray] = []
    for s in seen:
        picture = s.picture()
        face, known = face_colour(picture, s.head), s.known
        for _ in range(2):
            middle = known.middle + rng.normal(0, 0.04, 2) * known.hand
            size, turn = known.hand * np.exp(rng.normal(0, 0.08)), rng.normal(0, 0.12)
            hands.append(windows.coarse_vector(picture, middle, size, face, turn))
        size = HAND * s.head.head * np.exp(rng.normal(0, 0.1))
        others += [windows.coarse_vector(picture, place, size, face) for place in _elsewhere(s, picture, rng)]
    weights = _ridge(hands, others)
    for turn_number in range(ROUNDS):
        first = []
        for s in seen[turn_number::ROUNDS]:
            picture = s.picture()
            spots = search(picture, s.head, _template(weights), weights[1])
            first.append(bool(spots) and s.away(spots[0].x, spots[0].y) < 0.25)
            mistaken = [spot for spot in spots[:HARD_PLACES] if s.away(spot.x, spot.y) > 0.4]
            others += [windows.coarse_vector(picture, m.middle, m.hand, m.face) for m in mistaken]
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
    return balanced_ridge(np.array(hands + others), np.arange(len(hands) + len(others)) < len(hands), COARSE_RIDGE)


def _template(weights: Weights) -> np.ndarray:
    shape = (windows.COARSE, windows.COARSE, windows.CHANNELS)
    return weights[0].reshape(shape).astype(np.float32)


def _fine_windows(seen: list[Seen], coarse: Weights, rng: np.random.Generator) -> tuple[np.ndarray, np.ndarray]:
    vectors, labels = [], []
    for s in seen:
        for vector, label in _windows_of(s, coarse, rng):
            vectors.append(vector)
            labels.append(label)
    return np.array(vectors), np.array(labels)


def _windows_of(s: Seen, coarse: Weights, rng: np.random.Generator) -> Iterator[tuple[np.ndarray, str]]:
    """Yield the hand as it stands and as it is found, and the first place that is taken for a hand and is none."""
    picture, known = s.picture(), s.known
    for _ in range(3):
        middle = known.middle + rng.normal(0, JITTER[0], 2) * known.hand
        size = known.hand * np.exp(rng.normal(0, JITTER[1]))
        yield windows.fine_vector(picture, middle, size, rng.normal(0, JITTER[2])), known.label
    mistaken = False
    for spot in search(picture, s.head, _template(coarse), coarse[1])[:8]:
        away = s.away(spot.x, spot.y)
        if away < 0.22:
            yield windows.fine_vector(picture, spot.middle, spot.hand), known.label
        elif away > 0.4 and not mistaken:
            mistaken = True
            yield windows.fine_vector(picture, spot.middle, spot.hand), NO_HAND


def discriminant(vectors: np.ndarray, labels: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return weights (4860, classes), offsets and classes of a shrinkage LDA; both hands are learnt from each."""
    vectors = np.concatenate([vectors, windows.mirrored(vectors)])
    labels = np.concatenate([labels, labels])
    pca = PCA(min(COMPONENTS, *vectors.shape), svd_solver="covariance_eigh").fit(vectors)
    lda = LinearDiscriminantAnalysis(solver="eigen", shrinkage=SHRINKAGE).fit(pca.transform(vectors), labels)
    weights = pca.components_.T @ lda.coef_.T
    return weights, lda.intercept_ - pca.mean_ @ weights, lda.classes_
