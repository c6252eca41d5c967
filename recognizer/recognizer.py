"""The recogniser: clip in, recognition out; a stream underneath, so that the answer is there when the clip ends."""

from __future__ import annotations

import dataclasses
import os
import time
from collections.abc import Callable, Iterable

import numpy as np

from recognizer.errors import ClipError, DatabaseError
from recognizer.learning.database import Database
from recognizer.learning.decision import Decision
from recognizer.methods import method_of
from recognizer.motion.amplitude import amplitude
from recognizer.recognition import Evidence, Recognition
from recognizer.segmentation import Segmenter
from recognizer.tracking import MIN_SAMPLES, Track
from recognizer.video.clip import Clip, open_clip
from recognizer.video.samples import Sample
from recognizer.video.scene import STILL

Progress = Callable[[int, int | None], None]


class Recognizer:
    """Names gestures by their nearest neighbours in a database.

    Args:
        database: labelled vectors; see :meth:`load` and :meth:`fit`.
    """

    def __init__(self, database: Database) -> None:
        self.method = method_of(database)
        self.database = self.method.model.trainable(database)
        self.model = self.method.model().fit(self.database)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Recognizer:
        """Read a recogniser from its database file.

        Raises:
            DatabaseError: missing, damaged, or of another feature version.
        """
        return cls(Database.load(path))

    @classmethod
    def fit(cls, database: Database) -> Recognizer:
        """Learn from a database of labelled vectors."""
        return cls(database)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the database, with what was learned from it, atomically."""
        dataclasses.replace(self.database, arrays=self.model.arrays).save(path)

    @property
    def labels(self) -> list[str]:
        """Gestures that can be the answer."""
        return sorted(set(self.database.labels[self.database.families != "irrelevant"].tolist()))

    def stream(self, fps: float, source: str = "stream", first_index: int = 0) -> RecognizerStream:
        """Start a clip whose frames will be pushed one by one."""
        return RecognizerStream(self, Track(fps, first_index, source, self.method.needs_body))

    def recognize(
        self, clip: Clip | str | os.PathLike[str], among: Iterable[str] | None = None, progress: Progress | None = None
    ) -> Recognition:
        """Name the gesture of one clip.

        Args:
            clip: a clip, or the path of a video.
            among: labels that the context allows; all when None.
            progress: called with frames done and frames promised by the header.

        Raises:
            ClipError: the clip cannot be read or is too short.
            RecognizerError: ``among`` names an unknown gesture.
        """
        begun = time.perf_counter()
        clip = clip if isinstance(clip, Clip) else open_clip(clip)
        self._check_moving(clip)
        allowed = self.allowed(among)
        stream = self.stream(clip.fps, clip.source, clip.frames[0])
        total = clip.frame_count
        for number, frame in enumerate(clip, 1):
            stream.push(frame)
            if progress is not None:
                progress(number, total)
        read = time.perf_counter() - begun
        warnings = (*clip.warnings, *ends_early(clip, stream.track.sampler.pushed))
        return stream.finish(allowed, warnings, {"frames": read})

    def recognize_all(
        self, clip: Clip | str | os.PathLike[str], among: Iterable[str] | None = None, progress: Progress | None = None
    ) -> list[Recognition]:
        """Find where gestures begin and end in a long video, and answer each.

        Arguments and errors as :meth:`recognize`; a video without motion gives an empty list.
        """
        clip = clip if isinstance(clip, Clip) else open_clip(clip)
        self._check_moving(clip)
        allowed = self.allowed(among)
        segmenter = Segmenter(clip.fps, clip.frames[0], clip.source)
        answers: list[Recognition] = []

        def answer(samples: list[Sample]) -> None:
            if len(samples) >= MIN_SAMPLES:
                stream = self.stream(clip.fps, clip.source, clip.frames[0])
                for sample in samples:
                    stream.track.push_sample(sample)
                answers.append(stream.finish(allowed, clip.warnings))

        for number, frame in enumerate(clip, 1):
            for samples in segmenter.push(frame):
                answer(samples)
            if progress is not None:
                progress(number, clip.frame_count)
        for samples in segmenter.finish():
            answer(samples)
        return answers

    @staticmethod
    def _check_moving(clip: Clip) -> None:
        if clip.still:
            raise ClipError(f"{clip.source} is a photo; this database is of moving gestures; use one of postures")

    def allowed(self, among: Iterable[str] | None) -> set[str] | None:
        """Check the labels of a context; None means all."""
        if among is None:
            return None
        names = set(among)
        unknown = sorted(names - set(self.labels))
        if unknown or not names:
            raise DatabaseError(
                f"unknown gesture {', '.join(unknown) or '(none given)'}; known: {', '.join(self.labels)}"
            )
        return names

    def decide(self, vector: np.ndarray, among: set[str] | None = None) -> Decision:
        """Name a feature vector of this recogniser's method."""
        return self.model.decide(vector, among)


class RecognizerStream:
    """One clip in progress: :meth:`push` its frames, then :meth:`finish`."""

    def __init__(self, recognizer: Recognizer, track: Track) -> None:
        self.recognizer = recognizer
        self.track = track

    def push(self, frame: np.ndarray) -> None:
        """Take the next frame, (h, w, 3) uint8 BGR."""
        self.track.push(frame)

    def finish(
        self, among: set[str] | None = None, warnings: tuple[str, ...] = (), timings: dict[str, float] | None = None
    ) -> Recognition:
        """Answer for the frames pushed so far.

        Raises:
            ClipError: too few frames.
        """
        begun = time.perf_counter()
        self.track.end()
        vector = self.recognizer.method.features(self.track)
        decision = self.recognizer.decide(vector, among)
        if self.track.scene.still:
            decision = decision.rejected_for(STILL)
        samples = self.track.samples
        body = self.track.body if self.recognizer.method.needs_body else None
        height, width = samples[0].grey.shape
        return Recognition.of(
            decision,
            amplitude=amplitude(list(self.track.regions), (width, height)),
            start=samples[0].time,
            end=samples[-1].time,
            method=self.recognizer.database.method,
            source=self.track.source,
            warnings=(*warnings, *self.track.scene.warnings()),
            timings={**(timings or {}), "answer": time.perf_counter() - begun},
            evidence=Evidence(samples, list(self.track.regions), body),
        )


def ends_early(clip: Clip, read: int) -> tuple[str, ...]:
    """Say so when a file has clearly fewer frames than its header promises."""
    if clip.frame_count is None:
        return ()
    first, last = clip.frames
    promised = min(clip.frame_count, clip.frame_count if last is None else last + 1) - first
    if read < 0.9 * promised:
        return (f"only {read} of {promised} frames could be decoded; the file may be truncated",)
    return ()
