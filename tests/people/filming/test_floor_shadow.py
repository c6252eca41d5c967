"""The spot under the feet: on the floor where they are, and nowhere when they are at the lens or behind it."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.people.filming import floor_shadow
from nao_sim.people.filming.camera import Camera, View
from nao_sim.people.filming.floor_shadow import shade_floor

SIZE = (160, 120)


def shaded(depth: float) -> np.ndarray:
    """A grey floor with feet ``depth`` metres before a camera that looks down on them from 1 m."""
    view = View(Camera(pos=(0.0, 0.0, 1.0), aim=(2.0, 0.0, 0.0), fovy_deg=60.0, roll_deg=0.0), *SIZE)
    picture = np.full((SIZE[1], SIZE[0], 3), 200, np.uint8)
    shade_floor(picture, np.array([[depth, 0.1, 0.1], [depth, -0.1, 0.1]]), view)
    return picture


def test_the_floor_is_dark_under_the_feet() -> None:
    picture = shaded(2.0)
    row, column = np.unravel_index(np.argmin(picture[:, :, 0]), picture.shape[:2])
    assert abs(row - SIZE[1] / 2) < 12
    assert abs(column - SIZE[0] / 2) < 20
    assert picture[0, 0, 0] == 200


@pytest.mark.parametrize("depth", [-0.5, -0.4, -0.36, -0.33, -0.32, -0.3])
def test_feet_at_the_lens_ask_for_no_endless_blur(monkeypatch: pytest.MonkeyPatch, depth: float) -> None:
    asked: list[float] = []
    monkeypatch.setattr(floor_shadow.cv2, "GaussianBlur", lambda spot, size, edge: asked.append(edge) or spot)
    shaded(depth)
    assert all(edge <= SIZE[0] / 4 for edge in asked)
