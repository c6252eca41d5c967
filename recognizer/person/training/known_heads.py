"""Clips in which it is known where the head is: what finding it is learned from."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from pathlib import Path

import numpy as np

from recognizer.person.body_finder import OBSERVED
from recognizer.person.head_shoulders import Body
from recognizer.video.clip import open_clip
from recognizer.video.samples import Sampler


@dataclasses.dataclass(frozen=True)
class KnownHead:
    """Truth for one clip.

    Attributes:
        path: the clip.
        group: person, so that scores can be cross-fitted.
        track: (n, 3) centre x, y and height of the head in each frame, in fractions of the image's height.
    """

    path: Path
    group: str
    track: np.ndarray

    def body(self, frame: int, height: int) -> Body:
        """The head in a frame of an image ``height`` pixels high."""
        x, y, head = (self.track[min(frame, len(self.track) - 1)] * height).tolist()
        return Body(x, y, head, 0.0)


@dataclasses.dataclass(frozen=True)
class Picture:
    """A picture (h, w) uint8 with the head that is in it, and whose it is."""

    grey: np.ndarray
    body: Body
    group: str

    def mirrored(self) -> Picture:
        """The picture with left and right exchanged."""
        body = dataclasses.replace(self.body, x=self.grey.shape[1] - self.body.x)
        return dataclasses.replace(self, grey=np.ascontiguousarray(self.grey[:, ::-1]), body=body)


def pictures_of(known: KnownHead, observed: Sequence[int] = OBSERVED) -> list[Picture]:
    """Pictures in which the finder would search, where the head is in view."""
    clip = open_clip(known.path)
    sampler = Sampler(clip.fps)
    found = []
    taken = 0
    for frame in clip:
        sample = sampler.push(frame)
        if sample is None:
            continue
        taken += 1
        if taken in observed:
            body = known.body(sample.index, sample.grey.shape[0])
            if 0 < body.x < sample.grey.shape[1] and 0 < body.y < sample.grey.shape[0]:
                found.append(Picture(sample.grey, body, known.group))
    return found
