"""Which recogniser answers which kind of clip."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from pathlib import Path

from nao_sim.resources import resource
from recognizer import Clip, Recognition, Recognizer
from recognizer.postures import PhotoRecognizer


def database_of(clip: Clip) -> Path:
    """Return the database that comes with the package: postures for a photo, moving gestures for a video."""
    return resource("assets", "databases", "static.parquet" if clip.still else "dynamic.parquet")


def see(
    clip: Clip,
    database: Path,
    among: Iterable[str] | None = None,
    progress: Callable[[int, int | None], None] | None = None,
) -> Recognition:
    """Recognise what the person does.

    Args:
        clip: a video, or a photo.
        database: the database to ask.
        among: labels that the context allows; None for all.
        progress: called with frames done and frames promised by the file's header.
    """
    if clip.still:
        recognition = PhotoRecognizer.load(database).recognize(clip.source, among)
        if progress is not None:
            progress(1, 1)
        return recognition
    return Recognizer.load(database).recognize(clip, among, progress)
