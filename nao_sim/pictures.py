"""Pictures as files that are either whole or not there."""

from __future__ import annotations

import os
from pathlib import Path

import cv2
import numpy as np

from nao_sim.errors import NaoSimError


class PictureError(NaoSimError):
    """A picture that cannot be written."""


def write_picture(path: Path, image: np.ndarray) -> None:
    """Write a picture, BGR or grey, uint8; its suffix says the format.

    Raises:
        PictureError: no such format, or the place cannot be written.
    """
    try:
        encoded = cv2.imencode(path.suffix, image)[1].tobytes() if path.suffix else b""
    except cv2.error:
        encoded = b""
    if not encoded:
        raise PictureError(f"{path}: '{path.suffix}' is no picture format; end it in .png or .jpg")
    beside = path.with_name(f".{path.stem}.part{path.suffix}")
    try:
        beside.write_bytes(encoded)
        os.replace(beside, path)
    except OSError as error:
        raise PictureError(f"{path} cannot be written ({error.strerror}); choose another place") from None
    finally:
        beside.unlink(missing_ok=True)
