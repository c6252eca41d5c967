"""Watching one film: the recogniser's answer the moment it ends, and everything else afterwards."""

from __future__ import annotations

import time
from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property

import cv2
import numpy as np

from nao_sim.game.watch.movement import movement
from nao_sim.gestures import vocabulary
from nao_sim.resources import resource
from recognizer import Clip, Recognition, Recognizer, RecognizerError, RecognizerStream
from recognizer.postures import PhotoRecognizer

BLIND_GREY = 6.0
"""A picture whose grey levels spread less than this (standard deviation) shows nothing: a lid, darkness, glare."""
_JPEG = [cv2.IMWRITE_JPEG_QUALITY, 85]


@dataclass(frozen=True)
class Film:
    """Frames to be watched.

    Attributes:
        frames: BGR pictures, one by one, each with its time in seconds.
        fps: frames a second, as told.
        source: a name for messages.
        clip: the file that it is, which can be looked at again; None: it is seen once.
    """

    frames: Iterable[tuple[float, np.ndarray]]
    fps: float
    source: str
    clip: Clip | None = None

    @classmethod
    def of(cls, clip: Clip) -> Film:
        """Make a film of a file."""
        return cls(clip.timed(), clip.fps, clip.source, clip)


@dataclass
class Watched:
    """What a film showed.

    Attributes:
        recognition: the recogniser's answer; None: it could not answer.
        problem: why it could not; empty otherwise.
        pictures: the frames as JPEG, for the recording.
        fps: of the film.
        blind: nothing could be seen on it.
        ended: ``time.perf_counter()`` when the last frame was there.
        times: seconds of each frame, from the first.
        size: width and height of the frames, px.
    """

    recognition: Recognition | None = None
    problem: str = ""
    pictures: list[bytes] = field(default_factory=list)
    fps: float = 25.0
    blind: bool = False
    ended: float = 0.0
    times: list[float] = field(default_factory=list)
    size: tuple[int, int] = (0, 0)

    @property
    def seconds(self) -> float:
        """Length of the film."""
        return self.times[-1] + 1 / self.fps if self.times else 0.0

    @property
    def measured_fps(self) -> float:
        """Frames a second as they came."""
        return (len(self.times) - 1) / self.times[-1] if len(self.times) > 1 and self.times[-1] > 0 else self.fps

    def keep(self, seconds: float, frame: np.ndarray) -> None:
        """Add a frame to the pictures."""
        self.times.append(seconds)
        self.size = (frame.shape[1], frame.shape[0])
        self.pictures.append(cv2.imencode(".jpg", frame, _JPEG)[1].tobytes())

    def movement(self) -> tuple[float, float] | None:
        """First and last moment of movement, seconds of the film; None: nobody moved, or it is a photo."""
        if self.recognition is None or self.recognition.evidence is None:
            return None
        return movement(self.recognition.evidence, certain=self.recognition.label is not None)


class Watcher:
    """Watches films with one recogniser.

    Args:
        recognizer: of moving gestures.
        among: labels that the context allows; None: all.
    """

    def __init__(self, recognizer: Recognizer, among: Iterable[str] | None) -> None:
        self.recognizer = recognizer
        self._among = None if among is None else frozenset(among)

    @property
    def among(self) -> set[str] | None:
        """The labels of moving gestures that the context allows; None: all."""
        return None if self._among is None else set(self._among & set(self.recognizer.labels)) or None

    @cached_property
    def _photos(self) -> PhotoRecognizer:
        return PhotoRecognizer.load(resource("assets", "databases", "static.parquet"))

    @property
    def _postures(self) -> set[str] | None:
        """The hand postures that the context allows; None: all."""
        known = {name for name, entry in vocabulary().items() if entry.family == "static"}
        return None if self._among is None else set(self._among & known) or None

    def watch(self, film: Film) -> Watched:
        """Watch a film to its end; what cannot be recognised is said in the answer, not raised."""
        seen = Watched(fps=film.fps)
        if film.clip is not None and film.clip.still:
            return self._photo(film, film.clip, seen)
        stream = self.recognizer.stream(film.fps, film.source)
        spread = []
        try:
            for seconds, frame in film.frames:
                stream.push(frame, seconds)
                spread.append(float(frame[::8, ::8].std()))
                # JPEG of a frame takes a millisecond or two, which a camera leaves between its pictures.
                seen.keep(seconds, frame)
            seen.ended = time.perf_counter()
            seen.recognition = self._answer(stream, film)
        except RecognizerError as error:
            seen.ended = seen.ended or time.perf_counter()
            seen.problem = str(error)
        seen.blind = not spread or float(np.median(spread)) < BLIND_GREY
        return seen

    def _answer(self, stream: RecognizerStream, film: Film) -> Recognition:
        """Answer at once; a file that shows nothing known as a whole, or is long, is searched for its gesture."""
        answer = stream.finish(self.among)
        if film.clip is None or (stream.track.whole and not answer.rejected):
            return answer
        return self.recognizer.recognize(film.clip, self.among)

    def _photo(self, film: Film, photo: Clip, seen: Watched) -> Watched:
        for seconds, frame in film.frames:
            seen.keep(seconds, frame)
        seen.ended = time.perf_counter()
        try:
            seen.recognition = self._photos.recognize(photo.source, self._postures)
        except RecognizerError as error:
            seen.problem = str(error)
        return seen
