"""A film of the robot's motion, from its log."""

from __future__ import annotations

from pathlib import Path

import cv2
import mujoco
import numpy as np
from numpy.typing import NDArray

from nao_sim.episodes.errors import EpisodeError
from nao_sim.files import whole_file
from nao_sim.motion import MotionLog
from nao_sim.motion.self_distance import place_geoms
from nao_sim.rendering import gl_problem

FPS = 25
SIZE = (480, 480)
"""Width and height in pixels."""


def camera_in_front(log: MotionLog) -> mujoco.MjvCamera:
    """Return a camera that faces the robot and keeps the whole motion in view."""
    way = log.torso_pose[:, :2]
    camera = mujoco.MjvCamera()
    camera.lookat[:] = [*(way.min(axis=0) + way.max(axis=0)) / 2, 0.33]
    camera.distance = 1.05 + 1.5 * float(np.ptp(way, axis=0).max())
    camera.azimuth, camera.elevation = 180.0, -8.0
    return camera


def frames_of(
    model: mujoco.MjModel, log: MotionLog, times: NDArray[np.float64], size: tuple[int, int] = SIZE
) -> list[NDArray[np.uint8]]:
    """Render moments of a motion.

    Args:
        model: the model that made the log.
        log: the motion.
        times: seconds, shape (n,); the nearest logged moment is shown.
        size: width and height, pixels.

    Returns:
        n images, BGR, shape (height, width, 3).

    Raises:
        EpisodeError: this machine cannot render.
    """
    problem = gl_problem()
    if problem is not None:
        raise EpisodeError(problem)
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    camera = camera_in_front(log)
    shown = []
    renderer = mujoco.Renderer(model, size[1], size[0])
    try:
        for time in times:
            place_geoms(model, data, log.body_pose[int(np.abs(log.time - time).argmin())])
            renderer.update_scene(data, camera)
            shown.append(cv2.cvtColor(renderer.render(), cv2.COLOR_RGB2BGR).astype(np.uint8))
    finally:
        renderer.close()
    return shown


def _frames_in(path: Path) -> int:
    """Return how many pictures can be read from a video."""
    film, count = cv2.VideoCapture(str(path)), 0
    try:
        while film.isOpened() and film.grab():
            count += 1
    finally:
        film.release()
    return count


def film_robot(model: mujoco.MjModel, log: MotionLog, path: Path, size: tuple[int, int] = SIZE) -> None:
    """Write a motion as a video in real time, 25 frames a second; an older file is replaced as a whole.

    Raises:
        EpisodeError: this machine cannot render, or OpenCV cannot write such a file there.
    """
    if not path.absolute().parent.is_dir():
        raise EpisodeError(f"{path} cannot be written: {path.parent} is no folder; make it first")
    # A motion shorter than a picture still has one.
    frames = frames_of(model, log, np.arange(0.0, max(log.time[-1], 0.5 / FPS), 1.0 / FPS), size)
    with whole_file(path, ".mp4") as beside:
        writer = cv2.VideoWriter(str(beside), cv2.VideoWriter.fourcc(*"mp4v"), FPS, size)
        try:
            if not writer.isOpened():
                raise EpisodeError(f"{path} cannot be written as a video; choose a writable place and the suffix .mp4")
            for frame in frames:
                writer.write(frame)
        finally:
            writer.release()
        # OpenCV does not say that a disk was full; what it wrote does.
        if _frames_in(beside) != len(frames):
            raise EpisodeError(f"{path} could not be written whole; is the disk full? Free some space first")
