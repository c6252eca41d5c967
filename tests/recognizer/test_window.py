"""A window cut out of a shrunk part of the picture shows the place that the body says."""

from __future__ import annotations

import numpy as np
import pytest

from recognizer.finder import Body
from recognizer.window import POSE, WHOLE, View, cell_means, cut_window

WIDTH, HEIGHT = 1200, 900
SCALE = 5.0  # pixels of the picture to one of the window: shrunk first


@pytest.mark.parametrize("view", [WHOLE, POSE])
@pytest.mark.parametrize("at", [(600.0, 400.0), (60.0, 880.0), (1190.0, 20.0), (1900.0, -900.0)])
def test_a_window_shows_its_place_even_at_the_border(view: View, at: tuple[float, float]) -> None:
    head = SCALE * view.pixels
    width, height = view.size
    x = np.clip(at[0] + view.left * head + SCALE * np.arange(width), 0, WIDTH - 1)
    y = np.clip(at[1] + view.top * head + SCALE * np.arange(height), 0, HEIGHT - 1)
    for ramp, expected in (
        (np.tile(np.arange(WIDTH) / 5, (HEIGHT, 1)), np.tile(x / 5, (height, 1))),
        (np.tile(np.arange(HEIGHT)[:, None] / 5, (1, WIDTH)), np.tile(y[:, None] / 5, (1, width))),
    ):
        found = cut_window(ramp.round().astype(np.uint8), Body(*at, head, 1.0), view)
        # A pixel of the window is 1 grey level; the parts beyond the border repeat it.
        assert np.abs(found - expected).max() < 1.6
        assert abs(float((found - expected).mean())) < 0.75


@pytest.mark.parametrize("per_head", [1, 2])
def test_cells_are_means_of_their_pixels(per_head: int) -> None:
    maps = np.random.default_rng(0).normal(size=(3, 2, 64, 80)).astype(np.float32)
    side = 8 // per_head
    plain = maps.reshape(3, 2, 64 // side, side, 80 // side, side).mean(axis=(3, 5))
    np.testing.assert_allclose(cell_means(maps, per_head), plain, atol=1e-6)
    np.testing.assert_allclose(cell_means(maps[0, 0] > 0, per_head).mean(), (maps[0, 0] > 0).mean(), atol=1e-6)
