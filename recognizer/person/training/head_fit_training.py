"""How the steps of :mod:`recognizer.person.head_fit` are learned: from known heads, looked at a little aside."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

import numpy as np

from recognizer.person.head_fit import FARTHEST, STEPS, moved
from recognizer.person.head_shoulders import Body, closer_look
from recognizer.person.training.known_heads import Picture

RIDGE = 300.0
LOOKS_A_HEAD = 4
Step = tuple[np.ndarray, np.ndarray]
SPREAD = 0.2  # standard deviation of where the finder's places lie: head heights, and logarithm of the size


def learn_fit(pictures: Sequence[Picture], rng: np.random.Generator, tell: Callable[[str], None]) -> list[Step]:
    """Learn the steps, weights (2800, 3) and offset (3,) each.

    Every step is learned where the one before leads; for that, persons are halved and each half is moved by weights
    that the other half taught.

    Args:
        pictures: of two persons or more.
        rng: draws the places looked at.
        tell: called with a line of progress.
    """
    pictures = [both for picture in pictures for both in (picture, picture.mirrored())]
    start = [_aside(picture.body, rng) for picture in pictures for _ in range(LOOKS_A_HEAD)]
    truth = [picture for picture in pictures for _ in range(LOOKS_A_HEAD)]
    persons = sorted({picture.group for picture in truth})
    odd = np.isin([picture.group for picture in truth], persons[1::2])
    steps: list[Step] = []
    for step in range(STEPS):
        cells = np.concatenate([closer_look(t.grey, [b]) for t, b in zip(truth, start, strict=True)])
        target = np.array([_miss(b, t.body) for t, b in zip(truth, start, strict=True)], np.float32)
        tell(f"step {step}: {len(target)} looks, off by {_spread(target)}")
        steps.append(_ridge(cells, target))
        for half in (odd, ~odd):
            taught = _ridge(cells[~half], target[~half])
            there = np.flatnonzero(half)
            for k, body in zip(there, moved([start[k] for k in there], cells[half], *taught), strict=True):
                start[k] = body
    rest = np.array([_miss(b, t.body) for t, b in zip(truth, start, strict=True)])
    tell(f"persons left out end up off by {_spread(rest)}")
    return steps


def save_fit(steps: Sequence[Step], out: Path) -> None:
    """Write the file that :func:`recognizer.person.head_fit.fit_weights` reads."""
    weights, offsets = (np.array(part) for part in zip(*steps, strict=True))
    np.savez_compressed(out, weights=weights.astype(np.float16), offsets=offsets)


def _aside(body: Body, rng: np.random.Generator) -> Body:
    right, down, larger = np.clip(rng.normal(0, SPREAD, 3), -FARTHEST, FARTHEST)
    return Body(body.x + right * body.head, body.y + down * body.head, body.head * float(np.exp(larger)), 0.0)


def _miss(rough: Body, true: Body) -> tuple[float, float, float]:
    """The step that would lead from one to the other."""
    head = rough.head
    return (true.x - rough.x) / head, (true.y - rough.y) / head, float(np.log(true.head / head))


def _spread(miss: np.ndarray) -> str:
    right, down, size = np.median(np.abs(miss), axis=0)
    return f"{right:.3f} and {down:.3f} heads and {100 * size:.0f} % in size (medians)"


def _ridge(X: np.ndarray, y: np.ndarray) -> Step:
    """Weights (d, 3) and offset (3,) of ridge regression."""
    centre, level = X.mean(axis=0), y.mean(axis=0)
    Z = X - centre
    gram = (Z.T @ Z).astype(np.float64)
    gram[np.diag_indices_from(gram)] += RIDGE
    weights = np.linalg.solve(gram, (Z.T @ (y - level)).astype(np.float64)).astype(np.float32)
    return weights, (level - centre @ weights).astype(np.float32)
