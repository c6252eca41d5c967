"""Is the clip what the recogniser expects: one shot by a camera that stands still, with someone who moves?"""

from __future__ import annotations

import numpy as np

from recognizer.video.histograms import grey_histogram, histogram_intersection
from recognizer.video.samples import Sample

CUT_INTERSECTION = 0.6  # histograms of neighbouring samples agree less than this only across a cut …
CUT_DIFFERENCE = 25.0  # … where the pictures differ by as many grey levels in the mean, too
MOVING_SIDES = 3  # of four image borders move when the camera does
MOVING_SHARE = 0.3  # of all samples
STILL = "nothing moves in this clip"


class Scene:
    """Watches samples and motion as they come; :meth:`warnings` says what was wrong.

    Attributes:
        cut: whether the last sample is the first of another shot.
    """

    def __init__(self) -> None:
        self.cut = False
        self._before: tuple[np.ndarray, np.ndarray] | None = None
        self._cuts: list[float] = []
        self._steps = 0
        self._moving = 0
        self._camera = 0

    def observe(self, sample: Sample) -> None:
        """Compare a sample with the one before."""
        histogram = grey_histogram(sample.small, 32)
        self.cut = False
        if self._before is not None:
            alike = histogram_intersection(self._before[0], histogram)
            if alike < CUT_INTERSECTION and float(np.abs(sample.small - self._before[1]).mean()) > CUT_DIFFERENCE:
                self.cut = True
                self._cuts = [*self._cuts[-9:], sample.time]
        self._before = (histogram, sample.small)

    def observe_motion(self, area: float, sides: int) -> None:
        """Take how much of the sample's picture moves, 0 … 1, and how many of its four borders do."""
        self._steps += 1
        self._moving += area > 0
        self._camera += sides >= MOVING_SIDES

    @property
    def still(self) -> bool:
        """Whether nothing has moved in any sample."""
        return self._steps > 0 and not self._moving

    def warnings(self) -> tuple[str, ...]:
        """Return one line for each thing that makes the answer doubtful."""
        found = [f"the picture changes at once at {t:.1f} s: a cut? give one shot, with --frames" for t in self._cuts]
        if self._steps and self._camera > MOVING_SHARE * self._steps:
            found.append("the whole picture moves: film with a camera that stands still")
        if self.still:
            found.append(STILL)
        return tuple(found)
