"""Pictures from the robot's cameras, or from beside it, without a display."""

from __future__ import annotations

import atexit
import weakref
from typing import Any

import mujoco
import numpy as np

from nao_sim.robot.canvas import Canvas
from nao_sim.robot.errors import RenderError, UnknownNameError
from nao_sim.robot.wiring import Wiring

WIDTH_PX, HEIGHT_PX = 640, 480
"""The robot's cameras (thesis app. 1)."""

RATE_HZ = 30.0
"""Their image rate."""

_CAMERA = mujoco.mjtObj.mjOBJ_CAMERA
_HINT = "set MUJOCO_GL=egl (libegl1 libgl1-mesa-dri) or MUJOCO_GL=osmesa (libosmesa6)"


class Cameras:
    """Renders the cameras of one robot's scene; each size's OpenGL context is made at its first picture."""

    def __init__(self, wiring: Wiring) -> None:
        self._model, self._wiring = wiring.model, wiring
        self._canvases: dict[tuple[int, int, bool], Canvas] = {}

    def __getstate__(self) -> dict[str, Any]:
        # An OpenGL context belongs to its process; a copy makes its own.
        return self.__dict__ | {"_canvases": {}}

    @property
    def names(self) -> list[str]:
        """The cameras of the model, the scene's own included."""
        return [self._model.camera(k).name for k in range(self._model.ncam)]

    def render(
        self, data: mujoco.MjData, camera: str | mujoco.MjvCamera, width: int, height: int, fine: bool
    ) -> np.ndarray:
        """Return one ``(height, width, 3)`` uint8 RGB picture; see :meth:`nao_sim.robot.Nao.camera`."""
        view = self.fixed(camera) if isinstance(camera, str) else camera
        key = (width, height, fine)
        if key not in self._canvases:
            self._canvases[key] = self._canvas(*key)
        return self._canvases[key].draw(data, view)

    def fixed(self, name: str) -> mujoco.MjvCamera:
        """Return the robot's own camera of that name, or else the scene's.

        Raises:
            UnknownNameError: no such camera; the message names the nearest.
        """
        ids = [mujoco.mj_name2id(self._model, _CAMERA, known) for known in (self._wiring.named(name), name)]
        number = next((found for found in ids if found >= 0), -1)
        if number < 0:
            raise UnknownNameError("camera", name, self.names)
        camera = mujoco.MjvCamera()
        camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, number
        return camera

    def _canvas(self, width: int, height: int, fine: bool) -> Canvas:
        try:
            canvas = Canvas(self._model, width, height, fine)
        except Exception as error:  # each GL platform fails in its own way
            raise RenderError(f"no {width}x{height} picture: {error}; {_HINT}") from error
        # A GL context outlives the end of Python badly. Registered after it, this runs before GL shuts down.
        atexit.register(_close, weakref.ref(self))
        return canvas

    def close(self) -> None:
        """Free the GL contexts; the next picture makes new ones."""
        for canvas in self._canvases.values():
            canvas.close()
        self._canvases.clear()


def _close(cameras: weakref.ref[Cameras]) -> None:
    alive = cameras()
    if alive is not None:
        alive.close()
