"""Where exactly is the head, and how large is it? Linear steps from a rough place to a closer one.

The levels of the finder's pyramid are a fifth apart and its cells a third of a head wide. What the closer look sees
around a rough place also says which way it is off; two such steps, each learnt on what the one before leaves, are the
supervised descent of Xiong and De la Torre (CVPR 2013) for three numbers: right, down and larger.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence
from importlib.resources import files

import numpy as np

from recognizer.person.head_shoulders import Body, closer_look

STEPS = 2  # that are learnt; the last one is for places that are close already
FARTHEST = 0.5  # head heights, and in the logarithm of its height: a step goes no farther
_WEIGHTS = "head_fit.npz"


@functools.cache
def fit_weights() -> tuple[tuple[np.ndarray, np.ndarray], ...]:
    """Return the shipped weights (2800, 3) and offsets (3,) of every step."""
    with files("recognizer.person").joinpath(_WEIGHTS).open("rb") as file, np.load(file, allow_pickle=False) as stored:
        return tuple(zip(stored["weights"].astype(np.float32), stored["offsets"], strict=True))


def moved(bodies: Sequence[Body], cells: np.ndarray, weights: np.ndarray, offset: np.ndarray) -> list[Body]:
    """Move each body as its closer look says.

    Args:
        bodies: n rough places.
        cells: (n, 2800) what :func:`recognizer.person.head_shoulders.closer_look` sees around them.
        weights, offset: (2800, 3) and (3,), to right, down [head heights] and logarithm of the head's height.
    """
    moves = np.clip(cells @ weights + offset, -FARTHEST, FARTHEST)
    return [
        dataclasses.replace(b, x=b.x + float(right) * b.head, y=b.y + float(down) * b.head, head=b.head * float(size))
        for b, right, down, size in zip(bodies, moves[:, 0], moves[:, 1], np.exp(moves[:, 2]), strict=True)
    ]


def fit(grey: np.ndarray, body: Body, first: int = 0) -> Body:
    """Take the steps from ``first`` on in the picture ``grey`` (h, w) uint8."""
    for weights, offset in fit_weights()[first:]:
        body = moved([body], closer_look(grey, [body]), weights, offset)[0]
    return body
