"""How exactly is the head found? Against where it is, in a film whose shots are staged again.

Usage: python benchmarks/head_places.py SET

SET is a folder that ``nao-sim film`` made with this version. Who walks is left out. Heads move: what is found is
compared with the median of where they are and how large until it is found.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import cv2
import joblib
import numpy as np

from nao_sim.people.datasets.head_ground_truth import heads_of_film
from recognizer import open_clip
from recognizer.person.body_finder import BodyFinder
from recognizer.video.samples import Sampler

WITHIN = (0.1, 0.2, 0.35)


def miss(path: Path, track: np.ndarray) -> tuple[float, float]:
    """Distance [head heights] and difference in size [logarithm] of the head that the finder chooses."""
    cv2.setNumThreads(1)
    clip = open_clip(path)
    sampler, finder = Sampler(clip.fps), BodyFinder()
    for frame in clip:
        sample = sampler.push(frame)
        if sample is not None and finder.body is None:
            finder.observe(sample)
            seen = sampler.pushed
    body = finder.decide()
    x, y, head = np.median(track[:seen], axis=0) * sampler.samples[0].grey.shape[0]
    return float(np.hypot(body.x - x, body.y - y) / head), float(abs(np.log(body.head / head)))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("set", type=Path)
    folder = parser.parse_args().set
    heads = [
        (folder / row["file"], track) for row, track in heads_of_film(folder) if not row["label"].startswith("walk")
    ]
    missed = joblib.Parallel(n_jobs=-1, verbose=5)(joblib.delayed(miss)(*head) for head in heads)
    far, size = np.array(missed).T
    print(f"{len(heads)} clips: median {np.median(far):.3f} head heights aside, {100 * np.median(size):.1f} % in size")
    for limit in WITHIN:
        print(f"within {limit} of both: {100 * np.mean((far < limit) & (size < limit)):.1f} %")


if __name__ == "__main__":
    main()
