"""What moves without being anybody is no gesture."""

from __future__ import annotations

from collections.abc import Callable

import cv2
import numpy as np
import pytest

from recognizer import Clip, Recognizer

FRAMES, FPS, SIZE = 60, 20.0, (240, 320)
Film = Callable[[np.ndarray, float, np.random.Generator], np.ndarray]


def wall(rng: np.random.Generator) -> np.ndarray:
    """A wall with some texture, larger than the picture."""
    rough = cv2.GaussianBlur(rng.integers(0, 255, (300, 400, 3), np.uint8), (0, 0), 6)
    return cv2.normalize(rough, None, 70, 190, cv2.NORM_MINMAX)


def cut(wall: np.ndarray, x: float, y: float) -> np.ndarray:
    return cv2.getRectSubPix(wall, SIZE[::-1], (200 + x, 150 + y))


def box(wall: np.ndarray, x: float, y: float) -> np.ndarray:
    picture = cut(wall, 0, 0)
    cv2.rectangle(picture, (int(x), int(y)), (int(x) + 30, int(y) + 40), (110, 140, 200), -1)
    return picture


def brighter(picture: np.ndarray, by: np.ndarray | float) -> np.ndarray:
    return np.clip(picture + by, 0, 255).astype(np.uint8)


FILMS: dict[str, Film] = {
    "noise on a wall": lambda w, t, rng: brighter(cut(w, 0, 0), rng.normal(0, 12, (*SIZE, 3))),
    "noise all over": lambda w, t, rng: rng.integers(0, 255, (*SIZE, 3), np.uint8),
    "a flickering light": lambda w, t, rng: brighter(cut(w, 0, 0), 40 * np.sin(2 * np.pi * 3 * t)),
    "a camera that pans": lambda w, t, rng: cut(w, 12 * (t - 1.5), 0),
    "a camera that shakes": lambda w, t, rng: cut(w, *rng.normal(0, 4, 2)),
    "a box up and down": lambda w, t, rng: box(w, 90, 110 + 60 * np.sin(2 * np.pi * t)),
    "a box that swings": lambda w, t, rng: box(w, 90 + 40 * np.sin(4 * np.pi * t), 60),
}


@pytest.mark.parametrize("name", FILMS)
def test_what_moves_with_nobody_in_view_is_rejected(shipped: Recognizer, name: str) -> None:
    rng = np.random.default_rng(3)
    behind = wall(rng)
    clip = Clip.from_array([FILMS[name](behind, k / FPS, rng) for k in range(FRAMES)], FPS)
    assert shipped.recognize(clip).rejected
