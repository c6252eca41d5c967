"""Horn-Schunck over a pyramid of pictures: what moves several pixels is found on a small one first."""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.motion.flow import horn_schunck

LEVELS, ITERATIONS, ALPHA = 3, 12, 6.0


def coarse_to_fine(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Horn-Schunck from a quarter of the size upwards, each level refining what the coarser one found [px].

    A waving hand moves several pixels between samples, which one level alone cannot follow.
    """
    pairs = [(first, second)]
    for _ in range(LEVELS - 1):
        pairs.append((cv2.pyrDown(pairs[-1][0]), cv2.pyrDown(pairs[-1][1])))
    u, v = horn_schunck(*pairs[-1], ALPHA, ITERATIONS)
    for a, b in reversed(pairs[:-1]):
        height, width = a.shape
        u, v = cv2.resize(u, (width, height)) * 2, cv2.resize(v, (width, height)) * 2
        columns, rows = _grid(width, height)
        moved = cv2.remap(b, columns + u, rows + v, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        du, dv = horn_schunck(a, moved, ALPHA, ITERATIONS)
        u, v = u + du, v + dv
    return u, v


_grids: dict[tuple[int, int], tuple[np.ndarray, np.ndarray]] = {}


def _grid(width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    if (width, height) not in _grids:
        columns, rows = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
        _grids[width, height] = (columns, rows)
    return _grids[width, height]
