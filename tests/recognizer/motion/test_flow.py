from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np
import pytest

from recognizer.motion.flow import derivatives, horn_schunck


def plain_horn_schunck(
    first: np.ndarray, second: np.ndarray, alpha: float, iterations: int
) -> tuple[np.ndarray, np.ndarray]:
    """Equations 3 and 4 of chapter 3 as they are printed, in double precision."""

    def shifted(image: np.ndarray, dy: int, dx: int) -> np.ndarray:
        padded = np.pad(image, 1, mode="edge")
        return padded[1 + dy : 1 + dy + image.shape[0], 1 + dx : 1 + dx + image.shape[1]]

    a, b = first.astype(float), second.astype(float)
    corners = [(0, 0), (0, 1), (1, 0), (1, 1)]
    ix = sum(shifted(i, y, 1) - shifted(i, y, 0) for i in (a, b) for y in (0, 1)) / 4
    iy = sum(shifted(i, 1, x) - shifted(i, 0, x) for i in (a, b) for x in (0, 1)) / 4
    it = sum(shifted(b, *c) - shifted(a, *c) for c in corners) / 4

    def mean(field: np.ndarray) -> np.ndarray:
        near = sum(shifted(field, y, x) for y, x in ((0, 1), (1, 0), (0, -1), (-1, 0))) / 6
        far = sum(shifted(field, y, x) for y in (-1, 1) for x in (-1, 1)) / 12
        return near + far

    u, v = np.zeros_like(a), np.zeros_like(a)
    for _ in range(iterations):
        u_mean, v_mean = mean(u), mean(v)
        common = (ix * u_mean + iy * v_mean + it) / (alpha**2 + ix**2 + iy**2)
        u, v = u_mean - ix * common, v_mean - iy * common
    return u, v


def textured(rng: np.random.Generator, height: int = 48, width: int = 64) -> np.ndarray:
    return cv2.GaussianBlur(rng.uniform(0, 255, (height, width)).astype(np.float32), (0, 0), 3) * 3 % 255


@pytest.mark.parametrize("alpha", [1.0, 10.0, 40.0])
def test_equals_the_printed_equations(alpha: float) -> None:
    rng = np.random.default_rng(3)
    first = cv2.GaussianBlur(rng.uniform(0, 255, (48, 64)).astype(np.float32), (0, 0), 2)
    second = np.roll(first, 1, axis=1)
    for fast, plain in zip(
        horn_schunck(first, second, alpha, 100), plain_horn_schunck(first, second, alpha, 100), strict=True
    ):
        np.testing.assert_allclose(fast, plain, atol=1e-4)


def test_finds_the_direction_of_a_shift() -> None:
    rng = np.random.default_rng(0)
    first = cv2.GaussianBlur(rng.uniform(0, 255, (64, 64)).astype(np.float32), (0, 0), 4) * 4
    u, v = horn_schunck(first, np.roll(first, 1, axis=1), 3.0, 300)
    assert 0.8 < np.median(u[8:-8, 8:-8]) < 1.2
    assert abs(np.median(v[8:-8, 8:-8])) < 0.1


def test_equal_images_do_not_move() -> None:
    image = np.random.default_rng(1).integers(0, 255, (20, 30), dtype=np.uint8)
    u, v = horn_schunck(image, image)
    assert not u.any()
    assert not v.any()


def test_derivatives_of_a_ramp() -> None:
    y, x = np.mgrid[0:10, 0:12].astype(np.float32)
    ix, iy, it = derivatives(2 * x + 3 * y, 2 * x + 3 * y + 5)
    inside = np.s_[:-1, :-1]
    assert np.allclose(ix[inside], 2)
    assert np.allclose(iy[inside], 3)
    assert np.allclose(it, 5)


def test_a_start_is_used_and_kept() -> None:
    image = np.zeros((8, 8), np.float32)
    start = (np.ones((8, 8), np.float32), np.zeros((8, 8), np.float32))
    u, _ = horn_schunck(image, image, iterations=3, start=start)
    assert np.allclose(u, 1)
    assert np.allclose(start[0], 1)


@pytest.mark.parametrize("scene", ["RubberWhale", "Dimetrodon"])
def test_as_near_to_the_true_flow_as_the_plain_form(scene: str, recorded: Callable[[str], Path]) -> None:
    folder = recorded(f"flow/{scene}")
    first, second = (cv2.imread(str(folder / f"frame{i}.png"), cv2.IMREAD_GRAYSCALE)[:200, :200] for i in (10, 11))
    raw = np.fromfile(folder / "flow10.flo", np.float32)
    width, height = raw[1:3].view(np.int32)
    truth = raw[3:].reshape(height, width, 2)[:200, :200]
    known = np.abs(truth).max(axis=2) < 1e9

    def error(flow: tuple[np.ndarray, np.ndarray]) -> float:
        return float(np.hypot(flow[0] - truth[:, :, 0], flow[1] - truth[:, :, 1])[known].mean())

    still = float(np.hypot(truth[:, :, 0], truth[:, :, 1])[known].mean())
    fast, plain = error(horn_schunck(first, second, 5.0, 100)), error(plain_horn_schunck(first, second, 5.0, 100))
    assert fast == pytest.approx(plain, abs=1e-4)
    assert fast < 0.9 * still
