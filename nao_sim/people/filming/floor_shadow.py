"""The soft dark spot that a person leaves on the floor: not a cast shadow, but what joins feet and floor to the eye."""

from __future__ import annotations

import cv2
import numpy as np
from numpy.typing import NDArray

from nao_sim.people.arrays import Array
from nao_sim.people.filming.camera import View

STRENGTH = 0.5
# How far (m) the spot reaches beyond the ankles, sideways and forward, and how soft its edge is.
_REACH = np.array([0.17, 0.13])
_EDGE = 0.06
_AT_LENS = 10.0  # pixels a metre, in picture sides: nearer than some 10 cm
_TURN = np.linspace(0, 2 * np.pi, 20, endpoint=False)
_RING = np.stack([np.cos(_TURN), np.sin(_TURN)], axis=1)


def shade_floor(picture: NDArray[np.uint8], ankles: Array, view: View) -> None:
    """Darken ``picture`` (h, w, 3; its first row at the bottom) around the feet, in place.

    Args:
        picture: the room, before the person is laid over it.
        ankles: world positions (2, 3) of the ankles, m.
        view: where the floor is seen.
    """
    height, width = picture.shape[:2]
    spread = np.abs(ankles[1, :2] - ankles[0, :2]) / 2
    lifted = max(0.0, float(ankles[:, 2].min()) - 0.1)
    ground = np.zeros((len(_RING), 3))
    ground[:, :2] = ankles[:, :2].mean(axis=0) + _RING * (spread + _REACH)
    seen, scale = view.pixels(ground)
    # Feet at the lens, beside or behind it: their spot is not in the picture.
    if scale.min() <= 0 or scale.max() > _AT_LENS * max(height, width):
        return
    # Near feet would ask for a blur wider than the picture, which takes minutes.
    edge = float(np.clip(_EDGE * float(scale.mean()), 1.0, max(height, width) / 4))
    low, high = np.floor(seen.min(axis=0) - 2 * edge), np.ceil(seen.max(axis=0) + 2 * edge)
    left, bottom = (int(v) for v in np.maximum(low, 0))
    right, top = (int(v) for v in np.minimum(high, (width, height)))
    if left >= right or bottom >= top:
        return
    spot = np.zeros((top - bottom, right - left), np.float32)
    cv2.fillConvexPoly(spot, np.round(seen - (left, bottom)).astype(np.int32), STRENGTH * float(np.exp(-lifted / 0.1)))
    spot = np.asarray(cv2.GaussianBlur(spot, (0, 0), edge), dtype=np.float32)
    part = picture[bottom:top, left:right]
    part[:] = part * (1 - spot[:, :, None])
