"""Motion JPEG in AVI, written frame by frame.

OpenCV's own writer makes files 2.4 times as large at the same quality and has no fractional frame rates; the format is
RIFF chunks (Microsoft, *AVI RIFF File Reference*), which every player reads.
"""

from __future__ import annotations

import os
import struct
from fractions import Fraction
from pathlib import Path
from types import TracebackType

import cv2
import numpy as np
from numpy.typing import NDArray

from nao_sim.people.errors import FilmError

_HAS_INDEX, _KEY_FRAME = 0x10, 0x10


def _chunk(name: bytes, body: bytes) -> bytes:
    return name + struct.pack("<I", len(body)) + body + b"\0" * (len(body) % 2)


def _list(kind: bytes, body: bytes) -> bytes:
    return _chunk(b"LIST", kind + body)


class AviWriter:
    """Writes BGR frames (height, width, 3) to ``path``; nothing stands there until the last frame is written.

    A context manager: leaving it by an exception leaves no file behind. ``packed`` files are a fifth smaller, with the
    same pixels, and take three times as long to encode.
    """

    def __init__(self, path: Path, width: int, height: int, fps: float, quality: int, packed: bool = False) -> None:
        self._path, self._size = path, (width, height)
        self._encoding = [cv2.IMWRITE_JPEG_QUALITY, quality, cv2.IMWRITE_JPEG_OPTIMIZE, int(packed)]
        self._rate = Fraction(fps).limit_denominator(1001)
        self._part = path.with_name(f".{path.stem}.{os.getpid()}.part.avi")
        self._index: list[tuple[int, int]] = []
        self._at = 4

    def __enter__(self) -> AviWriter:
        self._path.parent.mkdir(parents=True, exist_ok=True)
        self._file = self._part.open("wb")
        # The lengths are not known yet: written again on leaving.
        self._file.write(self._header(0))
        return self

    def write(self, frame: NDArray[np.uint8]) -> None:
        """Append one frame."""
        done, jpeg = cv2.imencode(".jpg", frame, self._encoding)
        if not done:
            raise FilmError(f"a frame of {self._path} cannot be encoded; check its size and type")
        self.write_jpeg(jpeg.tobytes())

    def write_jpeg(self, jpeg: bytes) -> None:
        """Append one frame that is a JPEG file already, of the film's size."""
        chunk = _chunk(b"00dc", jpeg)
        self._index.append((self._at, len(jpeg)))
        self._at += len(chunk)
        self._file.write(chunk)

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if kind is None:
                rows = b"".join(struct.pack("<4sIII", b"00dc", _KEY_FRAME, at, size) for at, size in self._index)
                self._file.write(_chunk(b"idx1", rows))
                self._file.seek(0)
                self._file.write(self._header(len(rows) + 8))
            self._file.close()
            if kind is None:
                os.replace(self._part, self._path)
        finally:
            self._file.close()
            self._part.unlink(missing_ok=True)

    def _header(self, index_bytes: int) -> bytes:
        """Everything up to the first frame, for the frames written so far."""
        (width, height), frames = self._size, len(self._index)
        largest = max((size for _, size in self._index), default=0)
        micros = round(1e6 / self._rate)
        main = struct.pack("<14I", micros, 0, 0, _HAS_INDEX, frames, 0, 1, largest, width, height, 0, 0, 0, 0)
        stream = struct.pack(
            "<4s4sIHHIIIIIIII4H", b"vids", b"MJPG", 0, 0, 0, 0, self._rate.denominator, self._rate.numerator,
            0, frames, largest, 0xFFFFFFFF, 0, 0, 0, width, height,
        )  # fmt: skip
        bitmap = struct.pack("<IiiHH4sIiiII", 40, width, height, 1, 24, b"MJPG", width * height * 3, 0, 0, 0, 0)
        strl = _list(b"strl", _chunk(b"strh", stream) + _chunk(b"strf", bitmap))
        head = _list(b"hdrl", _chunk(b"avih", main) + strl)
        movie = b"LIST" + struct.pack("<I", self._at) + b"movi"
        total = 4 + len(head) + 8 + self._at + index_bytes
        return b"RIFF" + struct.pack("<I", total) + b"AVI " + head + movie
