"""What is measured on a clip while its frames arrive, and what every method reads when it has ended."""

from __future__ import annotations

import numpy as np

from recognizer.amplitude import MovingRegions, moving_mask, moving_regions
from recognizer.clip import Clip
from recognizer.errors import ClipError
from recognizer.flow import horn_schunck
from recognizer.samples import Sample, Sampler

MIN_SAMPLES = 6  # six key frames make the five states of a large gesture
FLOW_ITERATIONS = 30
ALPHA = 8.0


class Track:
    """Samples, flow and moving regions of a clip, frame by frame.

    Attributes:
        regions: moving regions of each kept sample; none for the first.
    """

    def __init__(self, fps: float, first_index: int = 0, source: str = "stream") -> None:
        self.source = source
        self.sampler = Sampler(fps, first_index)
        self.regions: list[MovingRegions] = []
        self._flow: tuple[np.ndarray, np.ndarray] | None = None
        self._before: Sample | None = None

    @property
    def samples(self) -> list[Sample]:
        """The samples kept, in order."""
        return list(self.sampler.samples)

    def push(self, frame: np.ndarray) -> None:
        """Take one frame, (h, w, 3) uint8 BGR, all of one size."""
        sample = self.sampler.push(frame)
        if sample is None:
            return
        before, self._before = self._before, sample
        if before is None:
            return
        if before.small.shape != sample.small.shape:
            raise ClipError(f"{self.source} changes its frame size on the way; convert it to one size")
        self._flow = horn_schunck(before.small, sample.small, ALPHA, FLOW_ITERATIONS, self._flow)
        mask = moving_mask(*self._flow, sample.time - before.time)
        self.regions.append(moving_regions(mask, sample.time))
        del self.regions[: -len(self.sampler.samples)]

    def check_length(self) -> None:
        """Raise ClipError when there are too few samples for a gesture."""
        n = len(self.sampler.samples)
        if n < MIN_SAMPLES:
            need = MIN_SAMPLES / min(self.sampler.fps, 10.0)
            raise ClipError(
                f"{self.source} has {self.sampler.pushed} frames, too short for a gesture; film {need:.1f} s or more"
            )


def track_clip(clip: Clip) -> Track:
    """Run all frames of a clip through a :class:`Track`."""
    track = Track(clip.fps, clip.frames[0], clip.source)
    for frame in clip:
        track.push(frame)
    return track
