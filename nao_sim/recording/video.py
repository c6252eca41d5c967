"""The clip in a recording, with what the recogniser saw drawn over it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TYPE_CHECKING

import cv2
import numpy as np

from nao_sim.recording.moments import column, moment

if TYPE_CHECKING:
    import rerun as rr

VIDEO = "video"
LONGEST_SIDE_PX = 640
"""Frames larger than this are stored smaller; a recording is for looking at, the clip itself is kept by its owner."""
_JPEG_QUALITY = 80
_CHUNK = 64

_GREEN, _YELLOW, _WHITE = [60, 220, 90], [255, 210, 60], [255, 255, 255]


def stored_scale(width: int, height: int) -> float:
    """Factor (at most 1) by which frames of this size are shrunk for the recording."""
    return min(1.0, LONGEST_SIDE_PX / max(width, height))


def _jpeg(image: np.ndarray, scale: float) -> bytes:
    if scale < 1.0:
        image = cv2.resize(image, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA)
    return cv2.imencode(".jpg", image, [cv2.IMWRITE_JPEG_QUALITY, _JPEG_QUALITY])[1].tobytes()


def log_frames(
    stream: rr.RecordingStream,
    frames: Iterable[tuple[float, np.ndarray]],
    progress: Callable[[int], None] | None = None,
) -> int:
    """Log frames as JPEG pictures, a few at a time, so that a long clip need not fit in memory.

    Args:
        stream: an open recording.
        frames: time [s] and BGR picture, uint8, shape (h, w, 3), of each.
        progress: called with the number of frames logged so far.

    Returns:
        The number of frames logged.
    """
    blobs: list[bytes] = []
    times: list[float] = []
    first = 0

    def send() -> None:
        log_pictures(stream, np.array(times), blobs)

    scale = 1.0
    for time, frame in frames:
        if first == 0 and not blobs:
            scale = stored_scale(frame.shape[1], frame.shape[0])
        blobs.append(_jpeg(frame, scale))
        times.append(time)
        if len(blobs) == _CHUNK:
            send()
            first += len(blobs)
            blobs.clear()
            times.clear()
            if progress is not None:
                progress(first)
    if blobs:
        send()
    if progress is not None:
        progress(first + len(blobs))
    return first + len(blobs)


def log_pictures(stream: rr.RecordingStream, times: np.ndarray, jpegs: Sequence[bytes]) -> None:
    """Log frames that are JPEG already; times are seconds on the timeline, shape (n,)."""
    import rerun as rr

    columns = rr.EncodedImage.columns(blob=list(jpegs), media_type=["image/jpeg"] * len(jpegs))
    stream.send_columns(f"{VIDEO}/frame", indexes=column(times), columns=columns)


def log_no_picture(stream: rr.RecordingStream, t: float) -> None:
    """Take the last picture and what is drawn over it away at a moment [s]."""
    import rerun as rr

    with moment(stream, t):
        stream.log(VIDEO, rr.Clear(recursive=True))


def log_boxes(stream: rr.RecordingStream, time: np.ndarray, boxes: Sequence[np.ndarray]) -> None:
    """Log the boxes around moving regions (thesis ch. 3, green rectangles).

    Args:
        stream: an open recording.
        time: seconds of each frame, shape (n,).
        boxes: for each frame, x, y, width, height in stored pixels, shape (k, 4); k may be 0.
    """
    import rerun as rr

    for t, box in zip(time, boxes, strict=True):
        box = np.asarray(box, dtype=float).reshape(-1, 4)
        with moment(stream, t):
            stream.log(f"{VIDEO}/flow", rr.Boxes2D(mins=box[:, :2], sizes=box[:, 2:], colors=_GREEN, radii=1.0))


def log_centroid_path(stream: rr.RecordingStream, time: np.ndarray, points: np.ndarray) -> None:
    """Log the path of the moving region's centroid, growing with time (thesis ch. 3, eq. 5).

    Args:
        stream: an open recording.
        time: seconds of each point, shape (n,).
        points: x, y in stored pixels, shape (n, 2).
    """
    import rerun as rr

    for i, t in enumerate(time):
        with moment(stream, t):
            stream.log(f"{VIDEO}/centroid", rr.Points2D(points[i : i + 1], colors=_YELLOW, radii=3.0))
            if i:
                stream.log(f"{VIDEO}/centroid_path", rr.LineStrips2D([points[: i + 1]], colors=_YELLOW, radii=0.8))


def log_ellipses(
    stream: rr.RecordingStream, entity: str, t: float, centres: np.ndarray, half_sizes: np.ndarray
) -> None:
    """Log the ellipses that stand for moving hands (thesis ch. 2, fig. 2-5).

    Args:
        stream: an open recording.
        entity: the picture they are drawn over.
        t: seconds on the timeline.
        centres: x, y of each ellipse in stored pixels, shape (k, 2).
        half_sizes: half axes along x and y in stored pixels, shape (k, 2).
    """
    import rerun as rr

    ellipses = rr.Ellipses2D(half_sizes=half_sizes, centers=centres, colors=_WHITE, line_radii=1.5)
    with moment(stream, t):
        stream.log(f"{entity}/ellipses", ellipses)


def log_picture(stream: rr.RecordingStream, entity: str, t: float, image: np.ndarray) -> None:
    """Log one picture (BGR or grey, uint8) of evidence at a moment."""
    import rerun as rr

    blob = cv2.imencode(".png", image)[1].tobytes()
    with moment(stream, t):
        stream.log(f"{entity}/picture", rr.EncodedImage(contents=blob, media_type="image/png"))
