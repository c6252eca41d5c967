"""Reading a photo, whatever it is stored as: colour, grey, with transparency, 8 or 16 bits."""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np

from recognizer.postures.errors import PhotoError
from recognizer.postures.types import Image

SMALLEST_SIDE = 32  # pixels: below, fingers are no longer apart
MOST_PIXELS = 100_000_000


def read_photo(path: str | os.PathLike[str]) -> Image:
    """Return the photo as (h, w, 3) uint8 BGR.

    Raises:
        PhotoError: missing, not a picture, damaged, too small or too large.
    """
    file = Path(path)
    try:
        data = np.fromfile(file, np.uint8)
    except OSError as error:
        raise PhotoError(f"cannot read {file}: {error.strerror or error}; give the path of a photo") from None
    try:
        image = cv2.imdecode(data, cv2.IMREAD_UNCHANGED) if len(data) else None
    except cv2.error:
        image = None
    if image is None:
        raise PhotoError(f"{file} is not a picture that can be read; save it again as JPEG or PNG")
    return as_bgr(image, str(file))


def as_bgr(image: np.ndarray, name: str = "the photo") -> Image:
    """Return any decoded picture as (h, w, 3) uint8 BGR.

    Args:
        image: (h, w), (h, w, 1), (h, w, 3) BGR or (h, w, 4) BGRA; uint8 or uint16. What is transparent becomes white.
        name: of the photo, for messages.

    Raises:
        PhotoError: another shape or type, too small or too large.
    """
    if image.ndim not in (2, 3) or (image.ndim == 3 and image.shape[2] not in (1, 3, 4)):
        raise PhotoError(f"{name} has shape {image.shape}; give a grey, BGR or BGRA picture")
    height, width = image.shape[:2]
    if min(height, width) < SMALLEST_SIDE:
        raise PhotoError(f"{name} is {width}x{height} pixels; a hand needs {SMALLEST_SIDE}x{SMALLEST_SIDE} at least")
    if height * width > MOST_PIXELS:
        raise PhotoError(f"{name} has {height * width / 1e6:.0f} megapixels; make it smaller than 100")
    if image.dtype == np.uint16:
        image = (image >> 8).astype(np.uint8)
    if image.dtype != np.uint8:
        raise PhotoError(f"{name} has pixels of type {image.dtype}; give 8 or 16 bit unsigned ones")
    if image.ndim == 2 or image.shape[2] == 1:
        return cv2.cvtColor(image.reshape(height, width), cv2.COLOR_GRAY2BGR)
    if image.shape[2] == 4:
        alpha = image[..., 3:].astype(np.float32) / 255
        return np.round(image[..., :3] * alpha + 255 * (1 - alpha)).astype(np.uint8)
    return image
