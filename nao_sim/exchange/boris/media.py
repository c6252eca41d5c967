"""What BORIS must know of a film: its length and frame rate."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class MediaFacts:
    """A film's length [s] and frame rate [1/s]."""

    length_s: float
    fps: float


def media_facts(path: Path) -> MediaFacts | None:
    """Return a film's facts; None where there is no film that can be read."""
    import cv2

    film = cv2.VideoCapture(str(path)) if path.is_file() else None
    if film is None or not film.isOpened():
        return None
    fps, frames = film.get(cv2.CAP_PROP_FPS), film.get(cv2.CAP_PROP_FRAME_COUNT)
    film.release()
    return MediaFacts(frames / fps, fps) if fps > 0 and frames > 0 else None
