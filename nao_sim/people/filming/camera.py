"""The static camera and the light of a clip, and where in the picture a point of the world appears."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from nao_sim.people.arrays import Array


@dataclass(frozen=True)
class Camera:
    """A static camera: position and aim (m), vertical field of view (degrees), roll (degrees)."""

    pos: tuple[float, float, float]
    aim: tuple[float, float, float]
    fovy_deg: float
    roll_deg: float = 0.0

    @property
    def slope(self) -> float:
        """Tangent of half of the vertical field of view."""
        return float(np.tan(np.radians(self.fovy_deg) / 2))

    def frame(self) -> Array:
        """The camera's axes in the world as columns (3, 3): right, up and backwards."""
        back = np.subtract(self.pos, self.aim)
        back /= np.linalg.norm(back)
        right = np.cross([0.0, 0.0, 1.0], back)
        right /= np.linalg.norm(right)
        roll = np.radians(self.roll_deg)
        turned = np.cos(roll) * right + np.sin(roll) * np.cross(back, right)
        return np.stack([turned, np.cross(back, turned), back], axis=1)

    def project(self, points: Array) -> Array:
        """Where world points (..., 3) in m appear (..., 2): right and up of the centre, in half image heights."""
        seen = np.subtract(points, self.pos) @ self.frame()
        return np.asarray(seen[..., :2] / -seen[..., 2:] / self.slope)


@dataclass(frozen=True)
class Light:
    """Two distant lights (unit directions, sRGB strengths) and the light from everywhere."""

    key_dir: tuple[float, float, float]
    key: tuple[float, float, float]
    fill_dir: tuple[float, float, float]
    fill: tuple[float, float, float]
    ambient: tuple[float, float, float]


class View:
    """A camera with a frame size: pixels, the first row at the bottom as OpenGL has it."""

    def __init__(self, camera: Camera, width: int, height: int) -> None:
        self._pos, self._frame, self._focal = np.array(camera.pos), camera.frame(), height / 2 / camera.slope
        self._centre = np.array([width / 2, height / 2])
        self._size = np.array([width, height])

    def pixels(self, points: Array) -> tuple[Array, Array]:
        """Column and row (n, 2) of world points (n, 3), and pixels a metre there (n,); below zero behind the camera."""
        seen = (points - self._pos) @ self._frame
        depth = -seen[:, 2]
        depth[depth == 0] = 1e-9  # in the camera's own plane, where nothing is seen
        scale = self._focal / depth
        return seen[:, :2] * scale[:, None] + self._centre, scale

    def box(self, points: Array, margin: float) -> tuple[int, int, int, int]:
        """Left, bottom, width and height of what is within ``margin`` (m) of ``points`` (n, 3); the whole if unsure."""
        places, scale = self.pixels(points)
        around = margin * scale[:, None]
        low = np.clip((places - around).min(axis=0), 0, self._size - 1).astype(int)
        high = np.clip(np.ceil((places + around).max(axis=0)), low + 1, self._size).astype(int)
        if scale.min() <= 0:
            low, high = np.zeros(2, int), self._size
        return int(low[0]), int(low[1]), int(high[0] - low[0]), int(high[1] - low[1])
