"""How fast clips are filmed, and what the time goes into.

    python benchmarks/film_speed.py [--clips 12] [--size 320 240]

Times one process, wall clock and processor time (which other jobs on the machine disturb less), over whole clips:
drawing, reshaping, the room, every frame, the sensor and the JPEG encoder.
"""

from __future__ import annotations

import argparse
import time
from collections import defaultdict
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import cv2
import numpy as np

from nao_sim.people.filming.film import exposed_angles, one_core
from nao_sim.people.filming.sensor import Exposure
from nao_sim.people.filming.shots import COARSE, draw_cast, draw_shot
from nao_sim.people.filming.stage import Stage
from nao_sim.people.performance.motions import IRRELEVANT, motions

WALL: dict[str, float] = defaultdict(float)
PROCESSOR: dict[str, float] = defaultdict(float)


def timed(name: str, work: Callable[[], Any]) -> Any:
    """Run ``work`` and book its time under ``name``."""
    wall, processor = time.perf_counter(), time.process_time()
    made = work()
    WALL[name] += time.perf_counter() - wall
    PROCESSOR[name] += time.process_time() - processor
    return made


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--clips", type=int, default=12)
    parser.add_argument("--size", type=int, nargs=2, default=(320, 240))
    options = parser.parse_args()
    width, height = options.size
    labels = [label for label in motions() if label != IRRELEVANT]
    frames = renders = 0
    with one_core(), Stage() as fine, Stage(COARSE) as coarse:
        for k in range(options.clips):
            shot = timed("draw", lambda k=k: draw_shot(1, labels[k % len(labels)], draw_cast(1, 6)[k % 6], k))
            shot = replace(shot, width=width, height=height)
            stage = fine if shot.detail == 1 else coarse
            stage.set_size(width, height)
            timed("reshape", lambda shot=shot, stage=stage: stage.cast(shot.person, shot.outfit))
            stage.furnish(shot.room)
            stage.light(shot.light)
            stage.aim(shot.camera)
            timed("room", stage.room_image)
            times = np.arange(shot.frames) / shot.fps
            angles, steps = timed("angles", lambda shot=shot, times=times: exposed_angles(shot, times))
            exposure = timed("sensor", lambda shot=shot: Exposure(shot.sensor, width, height))
            for frame, count in enumerate(steps):
                for step in range(count):
                    picture = timed("render", lambda a=angles[frame, step], stage=stage: stage.image(a))
                shown = timed("sensor", lambda e=exposure, p=picture, t=times[frame]: e.develop(p, float(t)))
                timed("encode", lambda s=shown: cv2.imencode(".jpg", s, [cv2.IMWRITE_JPEG_QUALITY, 65]))
                frames, renders = frames + 1, renders + count
    wall, processor = sum(WALL.values()), sum(PROCESSOR.values())
    print(f"{frames} frames of {width}x{height}, {renders} renders (motion blur takes more than one)")
    print(f"{frames / wall:.0f} frames a second of wall clock, {frames / processor:.0f} a second of processor time")
    for name, spent in sorted(PROCESSOR.items(), key=lambda item: -item[1]):
        print(f"  {name:8s} {1e3 * spent / frames:6.2f} ms a frame")


if __name__ == "__main__":
    main()
