"""Horn-Schunck optical flow (thesis ch. 3, eq. 1-4; Horn and Schunck, Artificial Intelligence 17, 1981)."""

from __future__ import annotations

import cv2
import numpy as np

# Neighbourhood average of eq. 3 and 4, and the 2×2×2 derivative estimates, both from Horn and Schunck's paper.
AVERAGE = np.array([[1, 2, 1], [2, 0, 2], [1, 2, 1]], np.float32) / 12
_DX = np.array([[-1, 1], [-1, 1]], np.float32) / 4
_DY = np.array([[-1, -1], [1, 1]], np.float32) / 4
_DT = np.full((2, 2), 0.25, np.float32)


def derivatives(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Return Ix, Iy, It of two grey images, (h, w) float32 each, from the cube of 2×2×2 neighbours."""

    def cube(image: np.ndarray, kernel: np.ndarray) -> np.ndarray:
        return cv2.filter2D(image, cv2.CV_32F, kernel, anchor=(0, 0), borderType=cv2.BORDER_REPLICATE)

    both = first + second
    return cube(both, _DX), cube(both, _DY), cube(second - first, _DT)


def horn_schunck(
    first: np.ndarray,
    second: np.ndarray,
    alpha: float = 10.0,
    iterations: int = 100,
    start: tuple[np.ndarray, np.ndarray] | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Estimate the velocity field between two grey images by eq. 3 and 4.

    Dividing the derivatives once by √(α² + Ix² + Iy²) takes the division out of the loop; what is left
    is done in place, u and v trading places with their averages.

    Args:
        first: (h, w) grey image, any numeric type.
        second: the next image, same shape.
        alpha: smoothness α in grey levels; larger for larger motion.
        iterations: number of Jacobi steps.
        start: initial (u, v), for example the flow of the pair before; zero when None.

    Returns:
        u, v: (h, w) float32, velocity right and down [px per frame].
    """
    first = np.ascontiguousarray(first, np.float32)
    second = np.ascontiguousarray(second, np.float32)
    ix, iy, it = derivatives(first, second)
    scale = 1.0 / np.sqrt(np.float32(alpha) ** 2 + ix * ix + iy * iy)
    ix *= scale
    iy *= scale
    it *= scale
    minus_ix, minus_iy = -ix, -iy
    u, v = (np.zeros_like(first), np.zeros_like(first)) if start is None else (start[0].copy(), start[1].copy())
    u_mean, v_mean, common = np.empty_like(u), np.empty_like(v), np.empty_like(u)
    average, accumulate = cv2.filter2D, cv2.accumulateProduct
    for _ in range(iterations):
        average(u, cv2.CV_32F, AVERAGE, u_mean, (-1, -1), 0, cv2.BORDER_REPLICATE)
        average(v, cv2.CV_32F, AVERAGE, v_mean, (-1, -1), 0, cv2.BORDER_REPLICATE)
        np.multiply(ix, u_mean, common)
        np.add(common, it, common)
        accumulate(iy, v_mean, common)
        accumulate(minus_ix, common, u_mean)
        accumulate(minus_iy, common, v_mean)
        u, u_mean = u_mean, u
        v, v_mean = v_mean, v
    return u, v
