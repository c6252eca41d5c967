"""Hold filmed clips beside real ones: framing, duration, optical flow, moving and skin pixels.

    python benchmarks/people_beside_real.py DATASET [REAL_CLIP ...] [--recordings FOLDER] [--clips 60]

Prints one row for the data set (10th, 50th and 90th percentile over its clips) and one for each real clip. All
measures are taken at a width of 160 pixels and 10 frames a second, and flow is given in image widths a second, so that
cameras compare. Without REAL_CLIPs: those of the recordings (docs/recordings.md).
"""

from __future__ import annotations

import argparse
import csv
from collections.abc import Iterator
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
from recordings import add_option, recorded

WIDTH, RATE = 160, 10.0
MOVING = 0.02  # image widths a second: slower than this is sway, noise and compression
NAMES = ("seconds", "flow_p95", "moving_max", "moving_mean", "skin_mean", "travel")


def frames(path: Path) -> Iterator[np.ndarray]:
    """Yield BGR frames of a clip at about ``RATE`` frames a second, ``WIDTH`` pixels wide."""
    video = cv2.VideoCapture(str(path))
    fps = video.get(cv2.CAP_PROP_FPS) or RATE
    number = kept = 0
    while True:
        read, frame = video.read()
        if not read:
            return
        if number >= kept * fps / RATE:
            kept += 1
            height = round(frame.shape[0] * WIDTH / frame.shape[1])
            yield cv2.resize(frame, (WIDTH, height), interpolation=cv2.INTER_AREA)
        number += 1


def skin_share(frame: np.ndarray) -> float:
    """Share of pixels in the thesis's skin range (ch. 1, eq. 1)."""
    luma = cv2.cvtColor(frame, cv2.COLOR_BGR2YCrCb)
    red, blue = luma[:, :, 1], luma[:, :, 2]
    return float(((red >= 133) & (red <= 173) & (blue >= 77) & (blue <= 127)).mean())


def measure(path: Path) -> np.ndarray:
    """The measures of one clip, in the order of ``NAMES``."""
    shown = list(frames(path))
    grey = [cv2.GaussianBlur(cv2.cvtColor(f, cv2.COLOR_BGR2GRAY), (0, 0), 1.2) for f in shown]
    speeds, moving, centres = [], [], []
    for one, two in pairwise(grey):
        flow = cv2.calcOpticalFlowFarneback(one, two, None, 0.5, 3, 13, 3, 5, 1.1, 0)
        speed = np.linalg.norm(flow, axis=2) * RATE / WIDTH
        fast = speed > MOVING * 3
        moving.append(fast.mean())
        if fast.sum() > 8:
            speeds.append(np.percentile(speed[fast], 90))
            centres.append(np.argwhere(fast).mean(axis=0) / WIDTH)
    travel = float(np.linalg.norm(np.ptp(np.array(centres), axis=0))) if centres else 0.0
    top = float(np.percentile(speeds, 95)) if speeds else 0.0
    skin = float(np.mean([skin_share(f) for f in shown]))
    peak, mean = float(np.max(moving, initial=0)), float(np.mean(moving)) if moving else 0.0
    return np.array([len(shown) / RATE, top, peak, mean, skin, travel])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("dataset", type=Path)
    parser.add_argument("real", type=Path, nargs="*")
    add_option(parser)
    parser.add_argument("--clips", type=int, default=60, help="how many of each class at most")
    parser.add_argument("--labels", nargs="*", help="only these classes")
    options = parser.parse_args()
    real = options.real or recorded(parser, options.recordings, "dynamic/*.*", "negative/*.m*")
    with (options.dataset / "manifest.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    print("| clips | " + " | ".join(NAMES) + " |\n|" + "---|" * (len(NAMES) + 1))
    for label in dict.fromkeys(row["label"] for row in rows):
        if options.labels and label not in options.labels:
            continue
        mine = [options.dataset / row["file"] for row in rows if row["label"] == label][: options.clips]
        low, middle, high = np.percentile([measure(path) for path in mine], [10, 50, 90], axis=0)
        cells = [f"{m:.3g} ({a:.2g}-{b:.2g})" for a, m, b in zip(low, middle, high, strict=True)]
        print(f"| {label} ({len(mine)}) | " + " | ".join(cells) + " |", flush=True)
    for path in real:
        print(f"| {path.name} | " + " | ".join(f"{v:.3g}" for v in measure(path)) + " |", flush=True)


if __name__ == "__main__":
    main()
