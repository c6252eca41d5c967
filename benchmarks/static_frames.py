"""How often is a posture named where none is shown? First and last frames of clips, answered as photos.

Usage: python benchmarks/static_frames.py [CLIP ...] [--recordings FOLDER]

Without CLIPs: those of the recordings (docs/recordings.md) in which nobody shows a posture.
"""

from __future__ import annotations

import argparse
from pathlib import Path

from recordings import add_option, recorded

from nao_sim.resources import resource
from recognizer import open_clip
from recognizer.postures import PhotoRecognizer
from recognizer.postures.errors import PhotoError

NO_POSTURE = ("negative/*.m*", "dynamic/PS7A1*.avi", "dynamic/PS7A3*.avi")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("clips", nargs="*", type=Path)
    add_option(parser)
    parser.add_argument("--database", type=Path, default=resource("assets", "databases", "static.parquet"))
    asked = parser.parse_args()
    clips = asked.clips or recorded(parser, asked.recordings, *NO_POSTURE)
    recognizer = PhotoRecognizer.load(asked.database)
    named = 0
    for path in clips:
        frames = list(open_clip(path))
        for which, frame in (("first", frames[0]), ("last", frames[-1])):
            try:
                label = recognizer.recognize(frame).label
            except PhotoError:
                label = None
            if label is not None:
                named += 1
                print(f"{path.name}, {which} frame: {label}")
    print(f"{named} of {2 * len(clips)} frames named")


if __name__ == "__main__":
    main()
