"""Pictures as files."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from nao_sim.files import FileError, whole_file


def write_picture(path: Path, image: np.ndarray) -> None:
    """Write a picture, BGR or grey, uint8; its suffix says the format.

    Raises:
        FileError: no such format, or the place cannot be written.
    """
    try:
        encoded = cv2.imencode(path.suffix, image)[1].tobytes() if path.suffix else b""
    except cv2.error:
        encoded = b""
    if not encoded:
        raise FileError(f"{path}: '{path.suffix}' is no picture format; end it in .png or .jpg")
    with whole_file(path) as beside:
        beside.write_bytes(encoded)
