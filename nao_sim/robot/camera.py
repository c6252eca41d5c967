"""Pictures from the robot's cameras, or from beside it, without a display."""

from __future__ import annotations

import atexit
import contextlib
import threading
import weakref
from typing import Any

import mujoco
import numpy as np

from nao_sim.rendering import gl_problem
from nao_sim.robot.canvas import Canvas
from nao_sim.robot.errors import RenderError, UnknownNameError
from nao_sim.robot.wiring import Wiring

WIDTH_PX, HEIGHT_PX = 640, 480
"""The robot's cameras (thesis app. 1)."""

RATE_HZ = 30.0
"""Their image rate."""

OUTSIDE = "outside"
"""A camera before the robot that follows it, where the scene has none of that name."""

_MOST_PX = 8192
_CAMERA = mujoco.mjtObj.mjOBJ_CAMERA


class Cameras:
    """Renders the cameras of one robot's scene; each size's OpenGL context is made at its first picture."""

    def __init__(self, wiring: Wiring) -> None:
        self._model, self._wiring = wiring.model, wiring
        self._canvases: dict[tuple[int, int, bool, int], Canvas] = {}

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
        view = self._view(data, camera) if isinstance(camera, str) else camera
        if not all(1 <= side <= _MOST_PX and side == int(side) for side in (width, height)):
            raise RenderError(f"a picture of {width}x{height} pixels; ask for whole numbers from 1 to {_MOST_PX}")
        # An OpenGL context belongs to the thread that made it.
        key = (int(width), int(height), bool(fine), threading.get_ident())
        if key not in self._canvases:
            self._canvases[key] = self._canvas(*key[:3])
        return self._canvases[key].draw(data, view)

    def _view(self, data: mujoco.MjData, name: str) -> mujoco.MjvCamera:
        """Return a camera by name; from outside, if the scene has no camera of that name."""
        if name == OUTSIDE and mujoco.mj_name2id(self._model, _CAMERA, name) < 0:
            camera = mujoco.MjvCamera()
            camera.lookat[:] = [*data.xpos[self._wiring.torso, :2], data.xpos[self._wiring.torso, 2] - 0.02]
            camera.distance, camera.azimuth, camera.elevation = 1.3, 150.0, -10.0
            return camera
        return self.fixed(name)

    def fixed(self, name: str) -> mujoco.MjvCamera:
        """Return the robot's own camera of that name, or else the scene's.

        Raises:
            UnknownNameError: no such camera; the message names the nearest.
        """
        ids = [mujoco.mj_name2id(self._model, _CAMERA, known) for known in (self._wiring.named(name), name)]
        number = next((found for found in ids if found >= 0), -1)
        if number < 0:
            raise UnknownNameError("camera", name, [*self.names, OUTSIDE])
        camera = mujoco.MjvCamera()
        camera.type, camera.fixedcamid = mujoco.mjtCamera.mjCAMERA_FIXED, number
        return camera

    def known(self, name: str) -> None:
        """Raise :class:`UnknownNameError` unless there is a camera of that name."""
        if name != OUTSIDE:
            self.fixed(name)

    def _canvas(self, width: int, height: int, fine: bool) -> Canvas:
        try:
            canvas = Canvas(self._model, width, height, fine)
        except Exception as error:  # each GL platform fails in its own way
            problem = gl_problem()
            reason = " ".join(str(error).split()) or type(error).__name__
            raise RenderError(problem or f"no {width}x{height} picture ({reason}); ask for a smaller one") from error
        # A GL context outlives the end of Python badly. Registered after it, this runs before GL shuts down.
        atexit.register(_close, weakref.ref(self))
        return canvas

    def close(self) -> None:
        """Free the GL contexts; the next picture makes new ones."""
        for canvas in self._canvases.values():
            # What another thread still holds goes with the process.
            with contextlib.suppress(Exception):
                canvas.close()
        self._canvases.clear()


def _close(cameras: weakref.ref[Cameras]) -> None:
    alive = cameras()
    if alive is not None:
        alive.close()
