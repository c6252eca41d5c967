"""A recogniser fed frame by frame, as a camera would: ``python examples/stream.py [VIDEO]``.

Every frame is worked on when it comes, so the answer is there as soon as the last one has been.
"""

from __future__ import annotations

import sys

from nao_sim.resources import resource
from recognizer import Recognizer, open_clip


def main(video: str) -> None:
    """Name the gesture of a video without ever holding more than a frame of it."""
    recognizer = Recognizer.load(resource("assets", "databases", "dynamic.parquet"))
    frames = open_clip(video)
    stream = recognizer.stream(frames.fps)
    for frame in frames:  # (h, w, 3) uint8 BGR, from anywhere
        stream.push(frame)
    answer = stream.finish()
    if answer.label is None:
        print(f"none of these: {answer.reason}")
    else:
        print(f"{answer.label}, distance {answer.distance:.2f} of at most {answer.threshold:.2f}")


if __name__ == "__main__":
    main(sys.argv[1] if len(sys.argv) > 1 else str(resource("assets", "clips", "bye_right.avi")))
