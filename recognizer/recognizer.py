"""The recogniser: clip in, recognition out; a stream underneath, so that the answer is there when the clip ends."""

from __future__ import annotations

import dataclasses
import math
import os
import time
from collections.abc import Callable, Iterable, Iterator

import numpy as np

from recognizer.errors import ClipError, DatabaseError, RecognizerError
from recognizer.learning.database import Database
from recognizer.learning.decision import Decision
from recognizer.methods import NOBODY, method_of
from recognizer.motion.amplitude import amplitude
from recognizer.motion.crossing import TRAVEL, thing_crosses
from recognizer.recognition import Evidence, Recognition, Watched
from recognizer.segmentation import Segmenter, only_gesture
from recognizer.tracking import MIN_SAMPLES, Track
from recognizer.video.clip import Clip, as_frame, open_clip
from recognizer.video.frame_clock import FrameClock
from recognizer.video.samples import KEPT_SECONDS, Sample
from recognizer.video.scene import STILL

Progress = Callable[[int, int | None], None]

RESTING = 2.0  # s of rest beside the only movement of a clip that make it worth a look of its own
THING = "what crosses the picture keeps its shape as a thing does; nobody walks"
NO_MOVEMENT = "no movement in this clip lasts long enough to be a gesture"


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

    def stream(self, fps: float | None = None, source: str = "stream", first_index: int = 0) -> RecognizerStream:
        """Start a clip whose frames will be pushed one by one.

        Args:
            fps: frames per second; None or 0, as cameras report that do not know theirs, when each frame will be
                pushed with its time.
            source: name for messages.
            first_index: number of the first frame in its source.

        Raises:
            ClipError: a rate that cannot be.
        """
        return RecognizerStream(self, Track(stream_rate(fps, source), first_index, source, self.method.needs_body))

    def recognize(
        self,
        clip: Clip | str | os.PathLike[str],
        among: Iterable[str] | str | None = None,
        progress: Progress | None = None,
    ) -> Recognition:
        """Name the gesture of one clip.

        A clip of up to 12 s is looked at as a whole; if that is no gesture but the clip has one movement between two
        rests, this movement. Of a longer one, the first of its movements that is a gesture is the answer. Where only a
        part was looked at, ``start`` and ``end`` say which, and a warning does.

        Args:
            clip: a clip, or the path of a video.
            among: labels that the context allows; all when None.
            progress: called with frames done and frames promised by the header.

        Raises:
            ClipError: the clip cannot be read or is too short.
            RecognizerError: ``among`` names an unknown gesture.
        """
        begun = time.perf_counter()
        clip = self._moving(clip)
        allowed = self.allowed(among)
        if (clip.seconds or 0.0) > KEPT_SECONDS:
            return self._of_long(clip, allowed, progress)
        stream = self.stream(clip.fps, clip.source, clip.frames[0])
        for number, (seconds, frame) in enumerate(clip.timed(), 1):
            stream.track.push(frame, seconds)
            if progress is not None:
                progress(number, clip.frame_count)
        if not stream.track.whole:  # the header did not say that it is long
            return self._of_long(clip, allowed, progress)
        read = time.perf_counter() - begun
        warnings = (*clip.warnings, *ends_early(clip, stream.track.sampler.pushed))
        answer = stream.answer(allowed, warnings, {"frames": read})
        part = only_gesture(stream.track.regions) if answer.rejected else None
        if part is None or part[1] - part[0] > answer.end - answer.start - RESTING:
            return answer
        samples = [sample for sample in stream.track.samples if part[0] <= sample.time <= part[1]]
        closer = self._of_samples(clip, samples, allowed, (*warnings, _part(answer, part, "the only movement in it")))
        return answer if closer.rejected else dataclasses.replace(closer, watched=answer.watched)

    def _of_long(self, clip: Clip, allowed: set[str] | None, progress: Progress | None) -> Recognition:
        """The first gesture of a clip that is longer than what is kept, or its first movement."""
        segmenter = Segmenter(clip.fps, clip.frames[0], clip.source)
        chosen, movements = None, 0
        for answer in self._each(clip, segmenter, allowed, progress):
            movements += 1
            if chosen is None or (chosen.rejected and not answer.rejected):
                chosen = answer
        early = ends_early(clip, segmenter.watch.sampler.pushed)
        watched = _watched(segmenter.watch)
        if chosen is None:
            rest = self._of_samples(clip, segmenter.watch.samples, allowed, (*clip.warnings, *early))
            return dataclasses.replace(rest.rejected_for(rest.reason or NO_MOVEMENT), watched=watched)
        which = "the only movement in it" if movements == 1 else f"the first gesture of its {movements} movements"
        if chosen.rejected and movements > 1:
            which = f"the first of its {movements} movements, none of them a gesture"
        told = (*chosen.warnings, *early, _part(None, (chosen.start, chosen.end), which, watched.seconds))
        return dataclasses.replace(chosen, warnings=told, watched=watched)

    def recognize_all(
        self,
        clip: Clip | str | os.PathLike[str],
        among: Iterable[str] | str | None = None,
        progress: Progress | None = None,
    ) -> list[Recognition]:
        """Find where gestures begin and end in a long video, and answer each.

        Arguments and errors as :meth:`recognize`; a video without motion gives an empty list.
        """
        return list(self.recognize_each(clip, among, progress))

    def recognize_each(
        self,
        clip: Clip | str | os.PathLike[str],
        among: Iterable[str] | str | None = None,
        progress: Progress | None = None,
    ) -> Iterator[Recognition]:
        """As :meth:`recognize_all`, each answer as soon as its gesture has ended, so that none need be kept."""
        clip = self._moving(clip)
        allowed = self.allowed(among)
        return self._each(clip, Segmenter(clip.fps, clip.frames[0], clip.source), allowed, progress)

    def _each(
        self, clip: Clip, segmenter: Segmenter, allowed: set[str] | None, progress: Progress | None
    ) -> Iterator[Recognition]:
        for number, (seconds, frame) in enumerate(clip.timed(), 1):
            for samples in segmenter.push(frame, seconds):
                if len(samples) >= MIN_SAMPLES:
                    yield self._of_samples(clip, samples, allowed, clip.warnings)
            if progress is not None:
                progress(number, clip.frame_count)
        for samples in segmenter.finish():
            if len(samples) >= MIN_SAMPLES:
                yield self._of_samples(clip, samples, allowed, clip.warnings)

    def _of_samples(
        self, clip: Clip, samples: list[Sample], allowed: set[str] | None, warnings: tuple[str, ...]
    ) -> Recognition:
        stream = self.stream(clip.fps, clip.source, clip.frames[0])
        for sample in samples:
            stream.track.push_sample(sample)
        return stream.answer(allowed, warnings)

    @staticmethod
    def _moving(clip: Clip | str | os.PathLike[str]) -> Clip:
        clip = clip if isinstance(clip, Clip) else open_clip(clip)
        if clip.still:
            raise ClipError(f"{clip.source} is a photo; this database is of moving gestures; use one of postures")
        return clip

    def allowed(self, among: Iterable[str] | str | None) -> set[str] | None:
        """Check the labels of a context; None means all."""
        if among is None:
            return None
        names = {among} if isinstance(among, str) else set(among)
        unknown = sorted(names - set(self.labels))
        if unknown or not names:
            raise DatabaseError(
                f"unknown gesture {', '.join(unknown) or '(none given)'}; known: {', '.join(self.labels)}"
            )
        return names

    def decide(self, vector: np.ndarray, among: set[str] | None = None) -> Decision:
        """Name a feature vector of this recogniser's method.

        Raises:
            RecognizerError: not numbers throughout, or not as many as the method has.
        """
        if np.shape(vector) != (len(self.method.names),) or not np.isfinite(vector).all():
            raise RecognizerError(
                f"a vector of {self.method.name} has {len(self.method.names)} finite numbers, "
                f"got {np.size(vector)} of which {np.isfinite(vector).sum()} are"
            )
        return self.model.decide(vector, among)


class RecognizerStream:
    """One clip in progress: :meth:`push` its frames, then :meth:`finish`."""

    def __init__(self, recognizer: Recognizer, track: Track) -> None:
        self.recognizer = recognizer
        self.track = track
        self._clock = FrameClock(track.sampler.fps)

    def push(self, frame: np.ndarray, seconds: float | None = None) -> None:
        """Take the next frame.

        Args:
            frame: (h, w, 3) uint8 BGR, or grey or with transparency as (h, w), (h, w, 1) or (h, w, 4); all of one size.
            seconds: when it was taken, of any origin; None at the stream's steady rate.

        Raises:
            ClipError: no such picture, another size than before, or no time where the stream has no rate.
        """
        source = self.track.source
        if seconds is None and self.track.sampler.fps is None:
            raise ClipError(f"{source} has no frame rate; give push() the time of each frame, or stream() its fps")
        if seconds is not None and not math.isfinite(seconds):
            raise ClipError(f"{source}: a frame at {seconds} s; times are finite numbers of seconds")
        self.track.push(as_frame(frame, source), self._clock(seconds))

    def finish(
        self,
        among: Iterable[str] | str | None = None,
        warnings: tuple[str, ...] = (),
        timings: dict[str, float] | None = None,
    ) -> Recognition:
        """Answer for the frames pushed so far, the last 12 s of them.

        Raises:
            ClipError: too few frames.
            RecognizerError: ``among`` names an unknown gesture.
        """
        return self.answer(self.recognizer.allowed(among), warnings, timings)

    def answer(
        self, allowed: set[str] | None, warnings: tuple[str, ...] = (), timings: dict[str, float] | None = None
    ) -> Recognition:
        """As :meth:`finish`, with labels that were checked."""
        begun = time.perf_counter()
        track = self.track
        track.end()
        if self.recognizer.method.needs_body and track.body is None:
            decision = Decision.without_comparison(NOBODY)
        else:
            decision = self.recognizer.decide(self.recognizer.method.features(track), allowed)
        samples = track.samples
        height, width = samples[0].grey.shape
        path = amplitude(list(track.regions), (width, height))
        if track.scene.still:
            decision = decision.rejected_for(STILL)
        far = self.recognizer.method.needs_body and not decision.rejected and path.extent > TRAVEL / 2
        if far and thing_crosses([sample.image for sample in samples]):
            decision = decision.rejected_for(THING)
        return Recognition.of(
            decision,
            amplitude=path,
            start=samples[0].time,
            end=samples[-1].time,
            watched=_watched(track),
            method=self.recognizer.database.method,
            source=track.source,
            warnings=(*warnings, *track.scene.warnings()),
            timings={**(timings or {}), "answer": time.perf_counter() - begun},
            evidence=Evidence(samples, list(track.regions), track.body),
        )


def stream_rate(fps: float | None, source: str = "stream") -> float | None:
    """Frames per second of a stream, None where it is not known; cameras report that as 0 or -1.

    Raises:
        ClipError: a rate that cannot be.
    """
    if fps is None or fps in (0, -1):
        return None
    if not (math.isfinite(fps) and fps > 0):
        raise ClipError(
            f"{source}: {fps} frames/s cannot be; give a positive number, or None and the time of each frame"
        )
    return float(fps)


def _watched(track: Track) -> Watched:
    sampler = track.sampler
    period = sampler.time / (sampler.pushed - 1) if sampler.pushed > 1 else 0.0
    return Watched(sampler.pushed, sampler.time + period)


def _part(whole: Recognition | None, part: tuple[float, float], which: str, seconds: float | None = None) -> str:
    """Say which part of a clip an answer is about."""
    lasts = seconds if whole is None else whole.watched.seconds
    return (
        f"the clip lasts {lasts:.1f} s; the answer is about {part[0]:.1f} to {part[1]:.1f} s, {which}; "
        "--all (recognize_all) answers each movement"
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
