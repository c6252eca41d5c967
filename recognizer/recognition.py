"""The answer to a clip, with the evidence for it."""

from __future__ import annotations

import dataclasses
import functools
import itertools
import math
from typing import Any

import numpy as np

from recognizer.learning.decision import Decision, Neighbour
from recognizer.motion.amplitude import Amplitude
from recognizer.motion.moving_regions import MovingRegions
from recognizer.person.head_shoulders import Body
from recognizer.thesis.difference_images import Ellipse, difference_image, ellipses
from recognizer.thesis.key_frames import equal_motion_frames
from recognizer.video.samples import Sample


class Evidence:
    """Pictures and numbers behind an answer, worked out when asked for.

    Attributes:
        samples: the frames that were looked at, in order, at most 10 a second.
        regions: moving regions of all samples but the first.
        body: the person who was found [px of the samples' pictures], None when the method does not look for one.
    """

    def __init__(self, samples: list[Sample], regions: list[MovingRegions], body: Body | None = None) -> None:
        self.samples = samples
        self.regions = regions
        self.body = body

    @functools.cached_property
    def key_samples(self) -> list[Sample]:
        """The least correlated pair of key frames, then the six key frames of the five states."""
        from recognizer.thesis.vectors import small_pair

        greys = [sample.grey for sample in self.samples]
        chosen = [*small_pair(greys), *equal_motion_frames(greys)]
        return [self.samples[int(i)] for i in chosen]

    @property
    def key_frames(self) -> list[int]:
        """Frame numbers in the source of :attr:`key_samples`."""
        return [sample.index for sample in self.key_samples]

    @property
    def key_images(self) -> list[np.ndarray]:
        """Pictures of :attr:`key_samples`, (h, w, 3) uint8 BGR."""
        return [sample.image for sample in self.key_samples]

    @functools.cached_property
    def difference_images(self) -> list[np.ndarray]:
        """Difference image of the pair, then of the five states, (h, w) uint8."""
        pair, states = self.key_samples[:2], self.key_samples[2:]
        pairs = [tuple(pair), *itertools.pairwise(states)]
        return [difference_image(a.grey, b.grey) for a, b in pairs]

    @functools.cached_property
    def ellipses(self) -> list[list[Ellipse]]:
        """One or two ellipses of each difference image (none without motion)."""
        return [ellipses(image) for image in self.difference_images]

    @property
    def boxes(self) -> list[np.ndarray]:
        """For each sample, (n, 4) x, y, width, height of what moves, as fractions of the image."""
        return [np.zeros((0, 4)), *(region.boxes for region in self.regions)]

    @property
    def centroid_path(self) -> np.ndarray:
        """(n, 2) centroid of motion of each sample as fractions of the image, NaN where nothing moves."""
        return np.array([(math.nan, math.nan), *(region.centroid for region in self.regions)])


@dataclasses.dataclass(frozen=True)
class Watched:
    """How much of a clip was looked at to find what the answer is about: frames, and the seconds they last."""

    frames: int
    seconds: float


@dataclasses.dataclass(frozen=True)
class Recognition:
    """What the person did, or why it is none of the known gestures.

    Attributes:
        label: the gesture, None when rejected.
        nearest: the best guess, even when rejected; empty where nothing could be compared, as without anybody in view.
        family: "small", "large" or "static", of ``nearest``.
        rejected: no gesture of the vocabulary.
        reason: why rejected, with the distance; empty otherwise.
        distance: by the default method the share of irrelevant motion in what speaks for it or the gesture, 0 … 1;
            otherwise to the nearest row of that gesture.
        threshold: distance beyond which a gesture is rejected; one like nothing known is rejected whatever its share,
            which ``reason`` says.
        votes: label -> share of the votes.
        neighbours: nearest rows of the database, nearest first.
        amplitude: small or large by the path of motion; None for a photo.
        start, end: seconds of the clip that the answer is about.
        watched: how much of the clip was looked at.
        method: name of the feature method.
        source: where the frames came from.
        warnings: what was odd (moving camera, cut, no motion, frame rate of the header …).
        timings: seconds spent, by stage.
        evidence: pictures and numbers behind the answer; None for a photo.
    """

    label: str | None
    nearest: str
    family: str
    rejected: bool
    reason: str
    distance: float
    threshold: float
    votes: dict[str, float]
    neighbours: tuple[Neighbour, ...]
    amplitude: Amplitude | None
    start: float
    end: float
    watched: Watched
    method: str
    source: str
    warnings: tuple[str, ...] = ()
    timings: dict[str, float] = dataclasses.field(default_factory=dict)
    evidence: Evidence | None = dataclasses.field(default=None, repr=False, compare=False)

    @classmethod
    def of(cls, decision: Decision, **rest: Any) -> Recognition:
        """Make a recognition from a decision and everything the decision does not know."""
        fields = {f.name: getattr(decision, f.name) for f in dataclasses.fields(decision)}
        return cls(**fields, **rest)

    def rejected_for(self, reason: str) -> Recognition:
        """The same, but rejected."""
        return dataclasses.replace(self, label=None, rejected=True, reason=reason)

    def to_dict(self) -> dict[str, Any]:
        """Everything but the pictures, as plain JSON-able values."""
        out = {
            f.name: getattr(self, f.name) for f in dataclasses.fields(self) if f.name not in ("evidence", "amplitude")
        }
        out["neighbours"] = [dataclasses.asdict(n) for n in self.neighbours]
        out["warnings"] = list(self.warnings)
        out["watched"] = dataclasses.asdict(self.watched)
        if self.amplitude is not None:
            out["amplitude"] = {**dataclasses.asdict(self.amplitude), "path": self.amplitude.path.round(4).tolist()}
        return {k: None if isinstance(v, float) and not math.isfinite(v) else v for k, v in out.items()}
