"""A window cut out of a shrunk part of the picture shows the place that the body says."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from recognizer.person.head_shoulders import Body
from recognizer.person.steps import Windows
from recognizer.person.view import GRID_X, GRID_Y, POSE, WHOLE, View, cell_means, cut_window
from recognizer.video.samples import Sample

WIDTH, HEIGHT = 1200, 900
SCALE = 5.0  # pixels of the picture to one of the window: shrunk first


@pytest.mark.parametrize("view", [WHOLE, POSE])
@pytest.mark.parametrize("at", [(600.0, 400.0), (60.0, 880.0), (1190.0, 20.0), (1900.0, -900.0)])
def test_a_window_shows_its_place_even_at_the_border(view: View, at: tuple[float, float]) -> None:
    head = SCALE * view.pixels
    width, height = view.size
    x = np.clip(at[0] + view.left * head + SCALE * (np.arange(width) + 0.5) - 0.5, 0, WIDTH - 1)
    y = np.clip(at[1] + view.top * head + SCALE * (np.arange(height) + 0.5) - 0.5, 0, HEIGHT - 1)
    for ramp, expected in (
        (np.tile(np.arange(WIDTH) / 5, (HEIGHT, 1)), np.tile(x / 5, (height, 1))),
        (np.tile(np.arange(HEIGHT)[:, None] / 5, (1, WIDTH)), np.tile(y[:, None] / 5, (1, width))),
    ):
        found = cut_window(ramp.astype(np.float32), Body(*at, head, 1.0), view)
        # A pixel of the window is 1 grey level; beyond the border the mean of the last four is repeated.
        assert np.abs(found - expected).max() < 0.95
        assert abs(float((found - expected).mean())) < 0.5


@pytest.mark.parametrize("shape", [(480, 24), (24, 480), (5, 5)])
@pytest.mark.parametrize("head", [4.0, 90.0, 400.0])
def test_a_picture_smaller_than_what_a_window_skips_is_cut_all_the_same(shape: tuple[int, int], head: float) -> None:
    for view in (WHOLE, POSE):
        window = cut_window(np.full(shape, 7, np.uint8), Body(12.0, 12.0, head, 1.0), view)
        assert window.shape == view.size[::-1]
        assert (window == 7).all()


def test_what_lies_beyond_the_picture_does_not_move() -> None:
    rng = np.random.default_rng(3)
    windows, body = Windows(Body(160.0, 40.0, 40.0, 1.0)), Body(160.0, 40.0, 40.0, 1.0)
    for k in range(2):  # noise, which seems to flow, and most where a border is repeated
        grey = rng.integers(0, 255, (240, 320)).astype(np.uint8)
        step = windows.push(Sample(k, 0.1 * k, grey[..., None].repeat(3, -1), grey, grey.astype(np.float32), ()), body)
    assert step is not None
    beyond = (GRID_Y < -1) | (np.abs(GRID_X) > 4)  # head heights
    assert not step.speed[beyond].any()
    assert step.speed[~beyond].any()


@pytest.mark.parametrize("per_head", [1, 2])
def test_cells_are_means_of_their_pixels(per_head: int) -> None:
    maps = np.random.default_rng(0).normal(size=(3, 2, 64, 80)).astype(np.float32)
    side = 8 // per_head
    plain = maps.reshape(3, 2, 64 // side, side, 80 // side, side).mean(axis=(3, 5))
    np.testing.assert_allclose(cell_means(maps, per_head), plain, atol=1e-6)
    np.testing.assert_allclose(cell_means(maps[0, 0] > 0, per_head).mean(), (maps[0, 0] > 0).mean(), atol=1e-6)


def test_motion_at_the_head_does_not_depend_on_where_its_window_is() -> None:
    noise = np.random.default_rng(2).uniform(0, 255, (240, 320)).astype(np.float32)
    picture = cv2.normalize(cv2.GaussianBlur(noise, (0, 0), 3), None, 0, 255, cv2.NORM_MINMAX).astype(np.uint8)
    shift = np.array([[1, 0, 4], [0, 1, -2]], np.float32)
    moved = cv2.warpAffine(picture, shift, (320, 240), borderMode=cv2.BORDER_REPLICATE)
    body = Body(160.0, 100.0, 40.0, 1.0)

    def head_flow(after: Body) -> np.ndarray:
        windows = Windows(body)
        steps = [
            windows.push(Sample(k, 0.1 * k, grey[..., None].repeat(3, -1), grey, grey.astype(np.float32), ()), head)
            for k, (grey, head) in enumerate(((picture, body), (moved, after)))
        ]
        assert steps[0] is None
        assert steps[1] is not None
        np.testing.assert_allclose(steps[1].place, [(after.x - 160) / 40, (after.y - 100) / 40], atol=1e-6)
        return np.median(steps[1].head_flow, axis=(1, 2))

    for head in (body, Body(164.0, 98.0, 40.0, 1.0), Body(156.0, 103.0, 40.0, 1.0)):
        np.testing.assert_allclose(head_flow(head), [1.0, -0.5], atol=0.12)  # a tenth of a head in a tenth of a second
