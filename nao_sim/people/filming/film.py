"""From shots to clips: frames, files, and a whole data set on several processes."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import cv2
import numpy as np

from nao_sim.people.arrays import Array, Image
from nao_sim.people.filming.avi_writer import AviWriter
from nao_sim.people.filming.sensor import Exposure
from nao_sim.people.filming.shots import Shot
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import of_a_finger

# Joints turning faster than this while the shutter is open leave a blur worth rendering.
_BLUR_RAD = np.radians(5.0)
_BLUR_STEPS = 3
# Small frames show the stairs of an outline: rendered at twice the size, which costs little there, and averaged.
_SMALL = 240


@contextmanager
def one_core() -> Iterator[None]:
    """Keep OpenCV and, when it is not yet at work, Mesa's software renderer from starting threads of their own.

    Their pictures are too small for it: the threads cost a third more processor time than they are worth.
    """
    os.environ.setdefault("LP_NUM_THREADS", "0")
    threads = cv2.getNumThreads()
    cv2.setNumThreads(1)
    try:
        yield
    finally:
        cv2.setNumThreads(threads)


def roll(stage: Stage, shot: Shot, fine: bool = False) -> Iterator[Image]:
    """Yield the BGR frames (h, w, 3) of ``shot``; ``fine`` ones are smoothed whatever their size."""
    scale = 2 if fine or shot.width <= _SMALL else 1
    stage.set_size(shot.width * scale, shot.height * scale)
    stage.cast(shot.person, shot.outfit)
    stage.furnish(shot.room)
    stage.light(shot.light)
    stage.aim(shot.camera)
    stage.room_image()
    times = np.arange(shot.frames) / shot.fps
    angles, steps = exposed_angles(shot, times)
    exposure = Exposure(shot.sensor, shot.width, shot.height)
    for k, time in enumerate(times):
        picture = stage.image(angles[k, 0])
        for step in range(1, steps[k]):
            share = 1 / (step + 1)
            picture = np.asarray(
                cv2.addWeighted(picture, 1 - share, stage.image(angles[k, step]), share, 0), dtype=np.uint8
            )
        if scale > 1:
            picture = np.asarray(cv2.resize(picture, (shot.width, shot.height), interpolation=cv2.INTER_AREA), np.uint8)
        yield exposure.develop(picture, float(time))


def exposed_angles(shot: Shot, times: Array) -> tuple[Array, list[int]]:
    """Joint angles (n, steps, nq) while the shutter is open, and how many of them each frame needs."""
    shutter = shot.sensor.shutter / shot.fps
    offsets = np.linspace(0, shutter, _BLUR_STEPS)
    angles = np.stack([shot.performance.angles(times + offset) for offset in offsets], axis=1)
    turning = np.abs(angles[:, -1] - angles[:, 0])
    fast = turning[:, ~of_a_finger()].max(axis=1) > _BLUR_RAD
    return angles, [_BLUR_STEPS if moving else 1 for moving in fast]


def write_clip(stage: Stage, shot: Shot, path: Path, fine: bool = False) -> None:
    """Render ``shot`` to ``path`` as MJPG in AVI, atomically; ``fine`` ones are smoothed and packed.

    Raises:
        FilmError: the encoder refuses.
        OSError: the disk does.
    """
    with AviWriter(path, shot.width, shot.height, shot.fps, shot.sensor.quality, packed=fine) as writer:
        for frame in roll(stage, shot, fine):
            writer.write(frame)
