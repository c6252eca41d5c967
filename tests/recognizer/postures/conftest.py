from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from recognizer.learning.database import Database
from recognizer.postures import PhotoRecognizer, learn_from_model_hand
from recognizer.postures.model_hand.silhouettes import silhouette
from recognizer.postures.model_hand.skeleton import Build, Posture, postures

SKIN_BGR = (110, 140, 200)
PAPER_BGR = (205, 205, 200)


def posture(name: str) -> Posture:
    return next(p for p in postures() if name in (p.label, p.action))


def hand_photo(mask: np.ndarray, skin: tuple[int, ...] = SKIN_BGR, paper: tuple[int, ...] = PAPER_BGR) -> np.ndarray:
    """A picture of a mask: skin before paper, softly lit, with sensor noise."""
    rng = np.random.default_rng(0)
    cover = cv2.GaussianBlur(mask.astype(np.float32), (0, 0), 0.7)[..., None]
    picture = cover * np.array(skin) + (1 - cover) * np.array(paper)
    light = np.linspace(1.05, 0.85, mask.shape[1])[None, :, None]
    return np.clip(picture * light + rng.normal(0, 2, picture.shape), 0, 255).astype(np.uint8)


def unseen_hands(name: str, count: int, seed: int = 77) -> list[np.ndarray]:
    rng = np.random.default_rng(seed)
    return [silhouette(posture(name), Build.draw(rng), rng) for _ in range(count)]


@pytest.fixture(scope="session")
def database() -> Database:
    """Small, so that the suite stays quick; the shipped one has more persons."""
    return learn_from_model_hand(persons=12, takes=2, seed=5)


@pytest.fixture(scope="session")
def recognizer(database: Database) -> PhotoRecognizer:
    return PhotoRecognizer(database)


@pytest.fixture(scope="session")
def real_photos(recorded: Callable[[str], Path]) -> Path:
    return recorded("static/labels.csv").parent
