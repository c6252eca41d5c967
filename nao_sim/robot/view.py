"""What a camera can see: its place, axes and the pyramid of its picture."""

from __future__ import annotations

from dataclasses import dataclass

import mujoco
import numpy as np


@dataclass(frozen=True)
class View:
    """A camera in the world.

    Attributes:
        position: ``(3,)`` m.
        axes: ``(3, 3)``, columns right, up and backwards.
        slopes: tangents of half the angles of view, across and upwards.
        far: distance at which pictures end, m.
        orthographic: the picture is a box, not a pyramid; then everything counts as seen.
    """

    position: np.ndarray
    axes: np.ndarray
    slopes: tuple[float, float]
    far: float
    orthographic: bool

    def sees(self, centres: np.ndarray, radii: np.ndarray) -> np.ndarray:
        """Return ``(n,)`` whether spheres at ``(n, 3)`` with ``(n,)`` radii may show; radius 0 is a boundless plane."""
        if self.orthographic:
            return np.ones(len(radii), dtype=bool)
        right, up, back = ((centres - self.position) @ self.axes).T
        seen = back < radii
        for across, slope in zip((right, up), self.slopes, strict=True):
            # Distance from the sphere's middle to the pyramid's side, which leans by the slope.
            seen &= np.abs(across) + back * slope < radii * np.hypot(1, slope)
        return seen | (radii == 0)

    def screen(self) -> tuple[np.ndarray, np.ndarray]:
        """Return centre ``(3,)`` and half sizes ``(3,)``, m, of a screen that fills the picture from behind."""
        distance = 0.99 * self.far
        across, up = self.slopes
        return self.position - distance * self.axes[:, 2], np.array([across * distance, up * distance, 0.0]) * 1.01


def view_of(scene: mujoco.MjvScene, aspect: float) -> View:
    """Return the view of a scene's camera, between its two eyes, for a picture of this width over height."""
    camera = mujoco.mjv_averageCamera(scene.camera[0], scene.camera[1])
    forward, up = np.array(camera.forward, dtype=float), np.array(camera.up, dtype=float)
    axes = np.column_stack([np.cross(forward, up), up, -forward])
    near = camera.frustum_near
    upwards = max(abs(camera.frustum_top), abs(camera.frustum_bottom))
    across = abs(camera.frustum_center) + aspect * (camera.frustum_top - camera.frustum_bottom) / 2
    return View(
        np.array(camera.pos, dtype=float),
        axes,
        (across / near, upwards / near),
        float(camera.frustum_far),
        bool(camera.orthographic),
    )
