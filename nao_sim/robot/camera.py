"""Pictures from the robot's cameras, or from beside it, without a display."""

from __future__ import annotations

import atexit
import weakref
from typing import Any

import mujoco
import numpy as np

from nao_sim.robot.errors import RenderError, UnknownNameError

WIDTH_PX, HEIGHT_PX = 640, 480
"""The robot's cameras (thesis app. 1)."""

RATE_HZ = 30.0
"""Their image rate."""

_HINT = "set MUJOCO_GL=egl (libegl1 libgl1-mesa-dri) or MUJOCO_GL=osmesa (libosmesa6)"


class Cameras:
    """Renders the cameras of one model; the GL context is made at the first picture."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self._model = model
        self._renderers: dict[tuple[int, int, bool], mujoco.Renderer] = {}

    @property
    def names(self) -> list[str]:
        """The cameras of the model, the scene's own included."""
        return [self._model.camera(k).name for k in range(self._model.ncam)]

    def render(
        self, data: mujoco.MjData, camera: str | mujoco.MjvCamera, width: int, height: int, fine: bool
    ) -> np.ndarray:
        """Return one ``(height, width, 3)`` uint8 RGB picture; see :meth:`nao_sim.robot.Nao.camera`."""
        if isinstance(camera, str) and camera not in self.names:
            raise UnknownNameError("camera", camera, self.names)
        key = (width, height, fine)
        if key not in self._renderers:
            self._renderers[key] = self._renderer(*key)
        renderer = self._renderers[key]
        renderer.update_scene(data, camera)
        renderer.scene.flags[mujoco.mjtRndFlag.mjRND_SHADOW] = fine
        return renderer.render().copy()

    def _renderer(self, width: int, height: int, fine: bool) -> Any:
        # Multisampling is fixed when the context is made; in software it costs as much as the picture itself.
        quality = self._model.vis.quality
        samples, quality.offsamples = quality.offsamples, quality.offsamples if fine else 0
        try:
            renderer = mujoco.Renderer(self._model, height, width)
        except Exception as error:  # each GL platform fails in its own way
            raise RenderError(f"no {width}x{height} picture: {error}; {_HINT}") from error
        finally:
            quality.offsamples = samples
        # A GL context outlives the end of Python badly. Registered after it, this runs before GL shuts down.
        atexit.register(_close, weakref.ref(self))
        return renderer

    def close(self) -> None:
        """Free the GL contexts; the next picture makes new ones."""
        for renderer in self._renderers.values():
            renderer.close()
        self._renderers.clear()


def _close(cameras: weakref.ref[Cameras]) -> None:
    alive = cameras()
    if alive is not None:
        alive.close()
