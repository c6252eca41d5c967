"""Things that slide are things; a walker's outline changes."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from recognizer import open_clip
from recognizer.motion.crossing import thing_crosses

SIZE = (320, 240)


def sliding(shape: str, size: float, squat: float, seed: int, leftward: bool, noise: float = 2.0) -> list[np.ndarray]:
    """A coloured shape that crosses a room's wall in three seconds, (30, 240, 320, 3) uint8."""
    rng = np.random.default_rng(seed)
    wall = cv2.resize(rng.integers(90, 150, (5, 6, 3), dtype=np.uint8), SIZE, interpolation=cv2.INTER_CUBIC)
    colour = [int(c) for c in rng.choice([20, 40, 220, 240], 3)]
    half_h, half_w = round(size * SIZE[1] / 2), max(6, round(size * squat * SIZE[1] / 2))
    out = []
    for t in np.linspace(0, 1, 30):
        x = round(-half_w + (1 - t if leftward else t) * (SIZE[0] + 2 * half_w))
        frame = wall.copy()
        if shape == "box":
            cv2.rectangle(frame, (x - half_w, 125 - half_h), (x + half_w, 125 + half_h), colour, -1)
        elif shape == "ball":
            cv2.circle(frame, (x, round(150 - 60 * abs(np.sin(9 * t)))), half_h, colour, -1)
        else:
            corners = [(x, 125 - half_h), (x - half_w, 125 + half_h), (x + half_w, 125 + half_h)]
            cv2.fillPoly(frame, [np.array(corners)], colour)
        out.append((frame + rng.normal(0, noise, frame.shape)).clip(0, 255).astype(np.uint8))
    return out


@settings(deadline=None, max_examples=25)
@given(
    shape=st.sampled_from(["box", "ball", "cone"]),
    size=st.floats(0.2, 0.7),
    squat=st.floats(0.4, 1.2),
    seed=st.integers(0, 10_000),
    leftward=st.booleans(),
)
def test_whatever_slides_is_a_thing(shape: str, size: float, squat: float, seed: int, leftward: bool) -> None:
    if shape == "ball":
        size = min(size, 0.4)
    assert thing_crosses(sliding(shape, size, squat, seed, leftward))


@pytest.mark.parametrize("name", ["walk_left_to_right", "walk_right_to_left"])
def test_a_walker_is_none(sample_clips: Path, name: str) -> None:
    assert not thing_crosses(list(open_clip(sample_clips / f"{name}.avi")))


def test_what_stays_where_it_is_is_not_asked_about() -> None:
    wall = np.full((*SIZE[::-1], 3), 120, np.uint8)
    assert not thing_crosses([wall] * 30)
    swinging = [cv2.circle(wall.copy(), (160 + round(20 * np.sin(t)), 100), 20, (0, 0, 255), -1) for t in range(30)]
    assert not thing_crosses(swinging)
