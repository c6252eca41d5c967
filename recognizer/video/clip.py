"""A clip: the frames of a video or photo, one by one, whatever the file throws at us."""

from __future__ import annotations

import dataclasses
import math
import os
import re
from collections.abc import Iterator, Sequence
from pathlib import Path

import numpy as np

from recognizer.errors import ClipError
from recognizer.video.frame_clock import ASSUMED_FPS, FrameClock, rate_of

# FFmpeg's own complaints would reach the user's terminal before ours; this is read when a capture is opened.
os.environ.setdefault("OPENCV_FFMPEG_LOGLEVEL", "-8")
import cv2

MAX_SIDE = 640  # px; larger frames (up to 8K and beyond) are scaled down while decoding
MIN_SIDE = 32  # px; below this a head is a single pixel
FPS_RANGE = (0.1, 1000.0)  # outside it the header is taken to be wrong, and the time stamps are asked
SLOWEST_FPS = 4.0  # below it nobody can be seen gesturing
STAMPS_READ = 30  # frames whose time stamps tell a rate that the header does not
# Pixels of a Motion JPEG frame up to which several threads cost more than they save (a tenth of a whole answer).
ONE_THREAD = 640 * 480
STILL_SUFFIXES = {".jpg", ".jpeg", ".jpe", ".png", ".bmp", ".webp", ".tif", ".tiff", ".ppm", ".pgm"}


@dataclasses.dataclass(frozen=True)
class Clip:
    """Frames of one video or photo, decoded anew at each iteration, so that memory does not grow with length.

    Attributes:
        source: where the frames come from; a file path, or a word for arrays.
        fps: frames per second, always finite and positive; of a file with uneven time stamps, as its header says.
        size: width and height of the frames as iterated [px].
        frame_count: number of frames that the header promises, None when it does not say.
        frames: first and last frame to use (both included, from 0); None for open ends.
        still: True for a photo.
        warnings: what was odd about the file, for the user.
        threads: that decode it; 0 leaves it to FFmpeg.
    """

    source: str
    fps: float
    size: tuple[int, int]
    frame_count: int | None = None
    frames: tuple[int, int | None] = (0, None)
    still: bool = False
    warnings: tuple[str, ...] = ()
    threads: int = 0
    array: np.ndarray | None = dataclasses.field(default=None, repr=False, compare=False)

    @property
    def seconds(self) -> float | None:
        """How long the part that is used lasts as the header promises, None when it does not say."""
        if self.frame_count is None:
            return None
        first, last = self.frames
        return (min(self.frame_count, self.frame_count if last is None else last + 1) - first) / self.fps

    def __iter__(self) -> Iterator[np.ndarray]:
        """Yield frames, (height, width, 3) uint8 BGR."""
        return (frame for _, frame in self.timed())

    def timed(self) -> Iterator[tuple[float, np.ndarray]]:
        """Yield time and picture of each frame: seconds from the first one used, (height, width, 3) uint8 BGR.

        The time is the file's own (see :class:`FrameClock`); frames in memory come at a steady rate.
        """
        clock = FrameClock(self.fps)
        return ((clock(stamp), frame) for stamp, frame in self._stamped())

    def _stamped(self) -> Iterator[tuple[float | None, np.ndarray]]:
        first, last = self.frames
        if self.array is not None:
            return ((None, frame) for frame in self.array[first : None if last is None else last + 1])
        if self.still:
            return iter([(None, _fit(_read_still(Path(self.source))))])
        return _decode(self.source, first, last, self.threads)

    @classmethod
    def from_array(cls, frames: Sequence[np.ndarray] | np.ndarray, fps: float, source: str = "array") -> Clip:
        """Make a clip of frames in memory.

        Args:
            frames: (n, height, width[, 1|3|4]) uint8, BGR or grey.
            fps: frames per second.
            source: a name for reports.

        Raises:
            ClipError: no frames, frames of different sizes, or not 8-bit images.
        """
        try:
            stack = np.asarray(frames)
        except ValueError:
            raise ClipError(f"{source}: frames differ in size; give frames of one size") from None
        if stack.ndim not in (3, 4) or len(stack) == 0 or stack.dtype != np.uint8:
            raise ClipError(
                f"{source}: need (n, height, width[, channels]) uint8 frames, got {stack.dtype} {stack.shape}"
            )
        stack = np.stack([as_frame(frame, source) for frame in stack])
        rate, warnings = _plausible_fps(fps)
        size = (stack.shape[2], stack.shape[1])
        return cls(source, rate, size, len(stack), still=len(stack) == 1, warnings=warnings, array=stack)


def open_clip(path: str | os.PathLike[str], frames: tuple[int, int | None] | None = None) -> Clip:
    """Open a video or a photo; the first frame is decoded, so that what cannot be read is said at once.

    Args:
        path: a file that FFmpeg or OpenCV can read.
        frames: first and last frame to use, both included, counted from 0.

    Raises:
        ClipError: missing, a folder, empty, truncated before the first frame, not a video, too small,
            or without the frames asked for.
    """
    file = Path(path)
    if not file.exists():
        raise ClipError(f"{file}: no such file; check the path")
    if file.is_dir():
        raise ClipError(f"{file} is a folder; give one video or photo in it")
    if file.stat().st_size == 0:
        raise ClipError(f"{file} is empty; record or copy it again")
    first, last = frames or (0, None)
    if first < 0 or (last is not None and last < first):
        raise ClipError(
            f"frames {first}:{'' if last is None else last}: the first must be 0 or more and not after the last"
        )
    if file.suffix.lower() in STILL_SUFFIXES:
        height, width = _fit(_read_still(file)).shape[:2]
        return Clip(str(file), ASSUMED_FPS, (width, height), 1, still=True)
    return _open_video(file, first, last)


def parse_frame_range(text: str) -> tuple[int, int | None]:
    """Read ``first:last`` (both included; either may be left out), as ``6:44`` or ``48:``.

    Raises:
        ClipError: not of that form.
    """
    match = re.fullmatch(r"\s*(\d*)\s*:\s*(\d*)\s*", text)
    if match is None:
        raise ClipError(f"frames '{text}': write FIRST:LAST, for example 6:44")
    return int(match[1] or 0), int(match[2]) if match[2] else None


def _open_video(file: Path, first: int, last: int | None) -> Clip:
    capture = cv2.VideoCapture(_url(str(file)), cv2.CAP_FFMPEG)
    try:
        if not capture.isOpened():
            raise ClipError(f"{file} is not a video that FFmpeg can read; convert it to mp4 or avi")
        header_fps = capture.get(cv2.CAP_PROP_FPS)
        promised = capture.get(cv2.CAP_PROP_FRAME_COUNT)
        codec = (int(capture.get(cv2.CAP_PROP_FOURCC)) & 0xFFFFFFFF).to_bytes(4, "little")
        count = int(promised) if math.isfinite(promised) and 0 < promised < 1e8 else None
        ok, frame = capture.read()
        if not ok or frame is None:
            raise ClipError(f"{file} holds no frame that can be decoded; it may be truncated, record or copy it again")
        fps, warnings = _plausible_fps(header_fps, None if _plausible(header_fps) else _stamps(capture))
    finally:
        capture.release()
    _check_size(str(file), frame.shape[1], frame.shape[0])
    if count is not None and first >= count:
        raise ClipError(f"{file} has {count} frames; frames {first}: starts after its end")
    height, width = _fit(frame).shape[:2]
    alone = codec == b"MJPG" and frame.shape[0] * frame.shape[1] <= ONE_THREAD
    return Clip(str(file), fps, (width, height), count, (first, last), warnings=warnings, threads=int(alone))


def _url(path: str) -> str:
    """A path as FFmpeg takes it: without the word before it, ``rec:1.avi`` would be a protocol called "rec"."""
    return f"file:{path}"


def _stamps(capture: cv2.VideoCapture) -> list[float]:
    """Time stamps [s] of the next frames."""
    stamps: list[float] = []
    while len(stamps) < STAMPS_READ and capture.grab():
        stamps.append(capture.get(cv2.CAP_PROP_POS_MSEC) / 1000)
    return stamps


def _decode(source: str, first: int, last: int | None, threads: int) -> Iterator[tuple[float, np.ndarray]]:
    capture = cv2.VideoCapture(_url(source), cv2.CAP_FFMPEG, [cv2.CAP_PROP_N_THREADS, threads] if threads else [])
    index = 0
    try:
        while last is None or index <= last:
            if not capture.grab():
                break
            if index >= first:
                ok, frame = capture.retrieve()
                if not ok or frame is None:
                    break
                yield capture.get(cv2.CAP_PROP_POS_MSEC) / 1000, _fit(_as_bgr(frame))
            index += 1
    finally:
        capture.release()
    if index <= first:
        raise ClipError(f"{source} ends after {index} frames; frames {first}: starts after its end")


def _plausible(fps: float | None) -> bool:
    return fps is not None and math.isfinite(fps) and FPS_RANGE[0] <= fps <= FPS_RANGE[1]


def _plausible_fps(fps: float, stamps: list[float] | None = None) -> tuple[float, tuple[str, ...]]:
    """The rate to go by, and a warning where it is not what the header says."""
    if _plausible(fps):
        return float(fps), ()
    told = rate_of(stamps or [])
    if told is not None and _plausible(told):
        return told, (f"the header's {fps:g} frames/s cannot be right; {told:g} by the time stamps",)
    return ASSUMED_FPS, (f"the header's {fps:g} frames/s cannot be right; {ASSUMED_FPS:g} assumed",)


def _read_still(file: Path) -> np.ndarray:
    # Read by bytes: cv2.imread warns on standard error about what it cannot open.
    data = np.frombuffer(file.read_bytes(), np.uint8)
    try:
        image = cv2.imdecode(data, cv2.IMREAD_COLOR)
    except cv2.error:
        image = None
    if image is None:
        raise ClipError(f"{file} is not a photo that OpenCV can read; convert it to png or jpg")
    _check_size(str(file), image.shape[1], image.shape[0])
    return image


def _check_size(source: str, width: int, height: int) -> None:
    if min(width, height) < MIN_SIDE:
        raise ClipError(f"{source} is {width}×{height} px; a person cannot be seen below {MIN_SIDE} px, film larger")


def as_frame(frame: np.ndarray, source: str) -> np.ndarray:
    """A picture from anywhere as a frame, (h, w, 3) uint8 BGR, of a size that is worked with.

    Raises:
        ClipError: not an 8-bit picture, or too small.
    """
    if not isinstance(frame, np.ndarray) or frame.dtype != np.uint8 or frame.ndim not in (2, 3):
        what = f"{frame.dtype} {frame.shape}" if isinstance(frame, np.ndarray) else type(frame).__name__
        raise ClipError(f"{source}: a frame is (h, w[, 1, 3 or 4]) uint8, got {what}; scale to 0 … 255 and convert")
    if frame.ndim == 3 and frame.shape[2] not in (1, 3, 4):
        raise ClipError(f"{source}: a frame has 1, 3 or 4 channels, got {frame.shape[2]}; convert it to BGR")
    _check_size(source, frame.shape[1], frame.shape[0])
    return _fit(_as_bgr(frame))


def _as_bgr(frame: np.ndarray) -> np.ndarray:
    if frame.ndim == 2 or frame.shape[2] == 1:
        return cv2.cvtColor(frame, cv2.COLOR_GRAY2BGR)
    return frame[:, :, :3] if frame.shape[2] == 4 else frame


def _fit(frame: np.ndarray) -> np.ndarray:
    """Scale a frame down to MAX_SIDE; smaller ones pass untouched."""
    height, width = frame.shape[:2]
    scale = MAX_SIDE / max(height, width)
    if scale >= 1:
        return frame
    size = (max(1, round(width * scale)), max(1, round(height * scale)))
    return cv2.resize(frame, size, interpolation=cv2.INTER_AREA)
