"""How fast is the recogniser? Everything is measured side by side in one run, on one thread.

    python benchmarks/recognition.py

Prints milliseconds and, because machines differ, each as a multiple of decoding the clip alone.
"""

from __future__ import annotations

import dataclasses
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

import cv2
import numpy as np

from nao_sim.resources import resource
from recognizer import Clip, Recognizer, open_clip
from recognizer.motion.flow import AVERAGE, derivatives, horn_schunck
from recognizer.person.body_finder import BodyFinder
from recognizer.video.samples import Sampler

SECONDS, FPS, SIZE = 3.0, 30.0, (320, 240)


def best_ms(work: Callable[[], object], times: int = 7) -> float:
    """Shortest of several runs [ms]."""
    shortest = np.inf
    for _ in range(times):
        begun = time.perf_counter()
        work()
        shortest = min(shortest, time.perf_counter() - begun)
    return float(shortest * 1e3)


def sample_file(folder: Path) -> Path:
    """A 3 s clip of 320×240 at 30 frames a second, MJPG, made of a sample clip."""
    frames = list(open_clip(resource("assets", "clips", "bye_right.avi")))
    path = folder / "clip.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), FPS, SIZE)
    for i in np.linspace(0, len(frames) - 1, int(SECONDS * FPS)).round().astype(int):
        writer.write(cv2.resize(frames[i], SIZE, interpolation=cv2.INTER_AREA))
    writer.release()
    return path


def plain_flow(first: np.ndarray, second: np.ndarray, alpha: float, iterations: int) -> tuple[np.ndarray, np.ndarray]:
    """Equations 3 and 4 in plain numpy, the averages by shifted copies."""
    ix, iy, it = derivatives(first, second)

    def mean(field: np.ndarray) -> np.ndarray:
        padded = np.pad(field, 1, mode="edge")
        height, width = field.shape
        parts = (AVERAGE[y, x] * padded[y : y + height, x : x + width] for y in range(3) for x in range(3))
        return sum(parts, np.zeros_like(field))

    u, v = np.zeros_like(first), np.zeros_like(first)
    for _ in range(iterations):
        u_mean, v_mean = mean(u), mean(v)
        common = (ix * u_mean + iy * v_mean + it) / (alpha**2 + ix**2 + iy**2)
        u, v = u_mean - ix * common, v_mean - iy * common
    return u, v


def without_flow(path: Path) -> None:
    """Decode, sample, look for the person: all that is done on frames except flow."""
    clip = open_clip(path)
    sampler, finder = Sampler(clip.fps), BodyFinder()
    for frame in clip:
        sample = sampler.push(frame)
        if sample is not None:
            finder.observe(sample)


def main() -> None:
    """Measure and print."""
    cv2.setNumThreads(1)
    shipped = resource("assets", "databases", "dynamic.parquet")
    recognizer = Recognizer.load(shipped)
    rows_alone = dataclasses.replace(recognizer.database, arrays={})
    with tempfile.TemporaryDirectory() as folder:
        path = sample_file(Path(folder))
        frames = list(open_clip(path))
        grey = [cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY).astype(np.float32) for frame in frames[40:42]]

        def streamed() -> float:
            stream = recognizer.stream(FPS)
            for frame in frames:
                stream.push(frame)
            begun = time.perf_counter()
            stream.finish()
            return (time.perf_counter() - begun) * 1e3

        decoding = best_ms(lambda: sum(1 for _ in open_clip(path)))
        rows = {
            "decode the clip": decoding,
            "features without flow, a frame": best_ms(lambda: without_flow(path)) / len(frames),
            "100 Horn-Schunck iterations, plain numpy": best_ms(lambda: plain_flow(*grey, 10.0, 100), 3),
            "100 Horn-Schunck iterations": best_ms(lambda: horn_schunck(*grey, 10.0, 100), 20),
            "answer to the file": best_ms(lambda: recognizer.recognize(path)),
            "answer to the same frames in memory": best_ms(lambda: recognizer.recognize(Clip.from_array(frames, FPS))),
            "answer after the last streamed frame": min(streamed() for _ in range(7)),
            "read the shipped database": best_ms(lambda: Recognizer.load(shipped), 3),
            f"learn from its {len(rows_alone)} clips anew": best_ms(lambda: Recognizer.fit(rows_alone), 2),
        }
    for name, value in rows.items():
        print(f"{name:45s} {value:8.2f} ms  {value / decoding:8.3f} x decoding")


if __name__ == "__main__":
    main()
