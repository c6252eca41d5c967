"""How the template of :mod:`recognizer.person.head_shoulders` is learned, from pictures with known heads.

Small steps, minutes on a laptop: a coarse template against the backgrounds it mistakes for people and the fit of the
exact place, both linear; a closer look at what the template likes; then, from clips of other persons, weights that
choose among a clip's candidates.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import cv2
import numpy as np

from recognizer.networks.hidden_layer import HiddenLayer
from recognizer.person import head_shoulders
from recognizer.person.body_finder import BodyFinder
from recognizer.person.head_fit import fit_weights, moved
from recognizer.person.head_shoulders import CELL, CHANNELS, HEAD, HEAD_AT, TALL, WIDE, Body
from recognizer.person.ranking import Ranking
from recognizer.person.training.closer_training import learn as learn_closer
from recognizer.person.training.head_fit_training import learn_fit, save_fit
from recognizer.person.training.known_heads import KnownHead, Picture, pictures_of
from recognizer.person.training.ranking_training import learn as learn_ranking
from recognizer.video.clip import open_clip
from recognizer.video.samples import Sampler

COARSE_RIDGE = 30.0
ROUNDS = 3  # of adding what is mistaken for a person
RANDOM_PLACES, HARD_PLACES = 20, 20  # a picture
Weights = tuple[np.ndarray, float]


def train(heads: Sequence[KnownHead], out: Path, fit: Path, seed: int = 0, tell: Callable[[str], None] = print) -> None:
    """Learn the template and the fit, and write their weights.

    Args:
        heads: clips with known heads, of several persons.
        out: the .npz file to write for the finder.
        fit: the .npz file to write for the fit.
        seed: of the random places that stand for background.
        tell: called with a line of progress.
    """
    rng = np.random.default_rng(seed)
    coarse = _coarse([picture for known in heads for picture in pictures_of(known, (1,))], rng, tell)
    steps = learn_fit([picture for known in heads for picture in pictures_of(known)], rng, tell)
    save_fit(steps, fit)
    np.savez_compressed(out, weights=coarse[0].astype(np.float16), offset=np.float32(coarse[1]))


def train_closer(heads: Sequence[KnownHead], seed: int = 0, tell: Callable[[str], None] = print) -> HiddenLayer:
    """Learn to tell heads from the other places that the shipped template likes."""
    clips = [_candidates(known) for known in heads]
    cells, right = (np.concatenate(parts) for parts in zip(*clips, strict=True))
    tell(f"{len(right)} candidates, {int(right.sum())} of them heads")
    return learn_closer(cells, right, seed, tell)


def train_ranking(heads: Sequence[KnownHead], tell: Callable[[str], None] = print) -> Ranking:
    """Learn to choose among candidates of the shipped templates, which must not know these persons."""
    tables, rights = [], []
    for known in heads:
        observer = _Observer()
        rights.append(observer.watch(known))
        tables.append(observer.candidates()[1])
    tell(f"{sum(len(right) for right in rights)} candidates, {sum(int(right.sum()) for right in rights)} of them heads")
    return learn_ranking(np.concatenate(tables), np.concatenate(rights))


def balanced_ridge(X: np.ndarray, positive: np.ndarray, ridge: float) -> Weights:
    """Least squares to ±1, both classes weighing the same: (d,) weights and an offset."""
    weight = np.where(positive, 0.5 / positive.sum(), 0.5 / (~positive).sum()) * len(X)
    target = np.where(positive, 1.0, -1.0)
    centre, level = np.average(X, axis=0, weights=weight), np.average(target, weights=weight)
    Z = (X - centre).astype(np.float32)
    weighted = Z * weight[:, None].astype(np.float32)
    covariance = (weighted.T @ Z).astype(np.float64)
    covariance[np.diag_indices_from(covariance)] += ridge
    solution = np.linalg.solve(covariance, weighted.T @ (target - level))
    return solution, float(level - centre @ solution)


def _coarse(pictures: list[Picture], rng: np.random.Generator, tell: Callable[[str], None]) -> Weights:
    """Heads against random places, then against the places that the template itself likes best."""
    X, y = [], []
    template: Weights | None = None
    for turn in range(ROUNDS + 1):
        for picture in pictures:
            for patch, positive in _patches(picture, template, rng):
                X.append(patch)
                y.append(positive)
        flat, offset = balanced_ridge(np.array(X, np.float32), np.array(y), COARSE_RIDGE)
        template = (flat.reshape(TALL, WIDE, CHANNELS).astype(np.float32), offset)
        tell(f"coarse template, round {turn}: {len(y)} patches")
    assert template is not None
    return template


def _patches(picture: Picture, template: Weights | None, rng: np.random.Generator) -> list[tuple[np.ndarray, bool]]:
    if rng.random() < 0.5:
        picture = picture.mirrored()
    grey, (x, y, head) = picture.grey, (picture.body.x, picture.body.y, picture.body.head)
    height, width = grey.shape
    out = []
    for _ in range(2):
        scale = HEAD / head * np.exp(rng.normal(0, 0.06))
        size = (max(8, round(width * scale)), max(8, round(height * scale)))
        level = head_shoulders.cells(
            cv2.resize(grey, size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        )
        jitter = rng.uniform(-0.4, 0.4, 2)
        place = (y * size[1] / height / CELL - 0.5 + jitter[0], x * size[0] / width / CELL - 0.5 + jitter[1])
        out.append((_patch(level, round(place[0]), round(place[1])), True))
    levels = head_shoulders.pyramid(grey)
    for size_, row, column, level in _places(grey, levels, template, rng):
        far = (
            np.hypot((column + 0.5) * width / level.shape[1] - x, (row + 0.5) * height / level.shape[0] - y)
            > 0.6 * head
        )
        if far or abs(np.log(size_ / head)) > 0.45:
            out.append((_patch(level, row, column), False))
    return out


def _places(
    grey: np.ndarray, levels: list[tuple[float, np.ndarray]], template: Weights | None, rng: np.random.Generator
) -> list[tuple[float, int, int, np.ndarray]]:
    if template is None:
        chosen = [levels[i] for i in rng.integers(len(levels), size=RANDOM_PLACES)]
        return [(h, int(rng.integers(c.shape[0])), int(rng.integers(c.shape[1])), c) for h, c in chosen]
    by_head = dict(levels)
    height, width = grey.shape
    found = head_shoulders.best_bodies(head_shoulders.score_maps(grey, *template), (width, height), HARD_PLACES)
    return [
        (
            b.head,
            int(b.y * by_head[b.head].shape[0] / height),
            int(b.x * by_head[b.head].shape[1] / width),
            by_head[b.head],
        )
        for b in found
    ]


def _patch(level: np.ndarray, row: int, column: int) -> np.ndarray:
    """The template's window of a pyramid level, flat; zero beyond the image."""
    top, left = row - int(HEAD_AT[1]), column - int(HEAD_AT[0])
    out = np.zeros((TALL, WIDE, CHANNELS), np.float32)
    first, last = max(0, top), min(level.shape[0], top + TALL)
    start, stop = max(0, left), min(level.shape[1], left + WIDE)
    if last > first and stop > start:
        out[first - top : last - top, start - left : stop - left] = level[first:last, start:stop]
    return out.ravel()


class _Observer(BodyFinder):
    """A finder that only collects candidates; which of them is right is known already."""

    def decide(self) -> Body:
        """Stop searching."""
        self.body = Body(0, 0, 1, 0)
        return self.body

    def watch(self, known: KnownHead) -> np.ndarray:
        """Look at a clip until a finder would decide; return which candidates are the head, (n,) bool."""
        clip = open_clip(known.path)
        sampler = Sampler(clip.fps)
        for frame in clip:
            sample = sampler.push(frame)
            if sample is not None:
                self.observe(sample)
        samples = list(sampler.samples)
        true = [known.body(samples[number].index, samples[0].grey.shape[0]) for number in self.searched()]
        right = [
            np.hypot(b.x - t.x, b.y - t.y) < 0.35 * t.head and abs(np.log(b.head / t.head)) < 0.25
            for b, t in zip(self.candidates()[0], true, strict=True)
        ]
        return np.array(right)


class _Collector(_Observer):
    """An observer that keeps what the closer look sees."""

    def __init__(self) -> None:
        super().__init__()
        self.cells: list[np.ndarray] = []

    def search(self, grey: np.ndarray) -> tuple[list[Body], np.ndarray]:
        """Candidates whose closer look is not scored."""
        height, width = grey.shape
        found = head_shoulders.best_bodies(head_shoulders.score_maps(grey, *head_shoulders.template()), (width, height))
        self.cells.append(head_shoulders.closer_look(grey, found))
        return moved(found, self.cells[-1], *fit_weights()[0]), np.zeros(len(found))


def _candidates(known: KnownHead) -> tuple[np.ndarray, np.ndarray]:
    """What the closer look sees of a clip's candidates (n, d), and which of them are the head (n,)."""
    collector = _Collector()
    right = collector.watch(known)
    return np.concatenate(collector.cells).astype(np.float16), right
