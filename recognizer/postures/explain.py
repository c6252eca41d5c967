"""Pictures of every stage, as the thesis's figures 1-5 to 1-15 show them, and of our hand frame."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

import cv2
import numpy as np

from recognizer.postures.candidates import Candidate
from recognizer.postures.errors import PhotoError
from recognizer.postures.hand.hand_frame import canonical_mask
from recognizer.postures.person.explain_person import person_pictures
from recognizer.postures.photo import as_bgr, read_photo
from recognizer.postures.photo_recognizer import PhotoRecognizer, Seen
from recognizer.postures.thesis import baseline
from recognizer.postures.thesis.chamfer import chamfer_distance
from recognizer.postures.types import Image, Mask

GREEN, RED, BLUE, YELLOW = (80, 200, 80), (60, 60, 230), (230, 120, 40), (40, 210, 240)
ZOOM = 3


def explain_photo(
    photo: Image | str | os.PathLike[str], recognizer: PhotoRecognizer, folder: str | os.PathLike[str]
) -> list[Path]:
    """Write PNG files of every stage into a folder and return their paths.

    Raises:
        PhotoError: the photo cannot be read, or shows nothing that could be a hand.
    """
    image = as_bgr(photo) if isinstance(photo, np.ndarray) else read_photo(photo)
    pictures: dict[str, Image] = {}
    with contextlib.suppress(PhotoError):  # where the thesis's chain finds nothing, ours may
        pictures.update(thesis_pictures(baseline.stages(image)))
    person = None if recognizer.method.name == baseline.METHOD else recognizer.person_in(image)
    if person is None:
        pictures.update(our_pictures(recognizer.look(image)))
    else:
        pictures.update(person_pictures(image, person))
        with contextlib.suppress(PhotoError):  # where no mask divides a hand from the room, the network may name it
            pictures.update(our_pictures(recognizer.look(image)))
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    paths = []
    for number, (name, picture) in enumerate(pictures.items(), 1):
        path = target / f"{number:02d}_{name}.png"
        temporary = path.with_name(f".{path.name}")
        temporary.write_bytes(cv2.imencode(".png", picture)[1].tobytes())
        os.replace(temporary, path)
        paths.append(path)
    return paths


def thesis_pictures(stages: baseline.Stages) -> dict[str, Image]:
    """Return one picture of each stage of the thesis's chain, by name, in order."""
    distance = chamfer_distance(stages.cleaned)
    distance = np.where(np.isfinite(distance), distance, 0)
    heat = cv2.applyColorMap((distance * (255 / max(distance.max(), 1))).astype(np.uint8), cv2.COLORMAP_VIRIDIS)
    return {
        "resized": _zoom(stages.resized),
        "gray_world": _zoom(stages.balanced),
        "skin": _zoom(_white(stages.skin)),
        "noise_removed": _zoom(_white(stages.cleaned)),
        "chamfer_distance": _zoom(heat),
        "feature_pixels_and_cut": _cut_picture(stages),
        "hand": _zoom(_white(stages.hand)),
        "sobel_contour": _zoom(_white(stages.edge)),
        "smoothed_contour": _outline_picture(stages),
    }


def our_pictures(seen: list[Seen]) -> dict[str, Image]:
    """Return the candidates, best first, with the frame of the chosen hand, and that hand as the features see it."""
    best = seen[0].candidate
    view = np.round(255 * canonical_mask(best.mask, best.frame)).astype(np.uint8)
    answers = [
        _captioned(_frame_picture(s.candidate), f"{s.decision.nearest or 'irrelevant'} {s.decision.distance:.1f}")
        for s in seen[:4]
    ]
    height = max(a.shape[0] for a in answers)
    padded = [cv2.copyMakeBorder(a, 0, height - a.shape[0], 0, 8, cv2.BORDER_CONSTANT) for a in answers]
    return {
        "candidates": np.hstack(padded),
        "palm_and_direction": _frame_picture(best),
        "hand_in_its_own_frame": cv2.resize(view, None, fx=6, fy=6, interpolation=cv2.INTER_NEAREST),
    }


def _cut_picture(stages: baseline.Stages) -> Image:
    cut = stages.cut
    picture = _white(stages.cleaned) // 3
    picture[cut.hand] = 200
    picture[cut.features] = YELLOW
    picture = _zoom(picture)
    c, m, p = (_pixel(point) for point in (cut.centroid, cut.fingers_mean, cut.point))
    along = cut.fingers_mean - cut.centroid
    if along.any():
        across = np.array([-along[1], along[0]]) / np.hypot(*along) * max(stages.skin.shape)
        cv2.line(picture, _pixel(cut.point - across), _pixel(cut.point + across), BLUE, 2)
    cv2.line(picture, p, m, RED, 2)
    for point in (c, m, p):
        cv2.circle(picture, point, 5, RED, -1)
    return picture


def _outline_picture(stages: baseline.Stages) -> Image:
    picture = _zoom(_white(stages.hand) // 4)
    points = np.round((stages.outline + 0.5) * ZOOM).astype(np.int32)
    return cv2.polylines(picture, [points], True, GREEN, 2, cv2.LINE_AA)


def _frame_picture(candidate: Candidate) -> Image:
    frame = candidate.frame
    picture = candidate.image.copy()
    picture[~candidate.mask] //= 3
    picture = _zoom(picture)
    tip = frame.centre + 2 * frame.radius * np.array([np.sin(frame.up_rad), -np.cos(frame.up_rad)])
    colour = GREEN if frame.arm_found else YELLOW
    cv2.circle(picture, _pixel(frame.centre), round(frame.radius * ZOOM), colour, 3, cv2.LINE_AA)
    return cv2.arrowedLine(picture, _pixel(frame.centre), _pixel(tip), colour, 3, cv2.LINE_AA)


def _captioned(picture: Image, text: str) -> Image:
    strip = np.full((34, picture.shape[1], 3), 30, np.uint8)
    cv2.putText(strip, text, (8, 24), cv2.FONT_HERSHEY_SIMPLEX, 0.7, (240, 240, 240), 1, cv2.LINE_AA)
    return np.vstack([picture, strip])


def _white(mask: Mask) -> Image:
    return np.repeat(mask[..., None].astype(np.uint8) * 255, 3, axis=2)


def _zoom(picture: Image) -> Image:
    return cv2.resize(picture, None, fx=ZOOM, fy=ZOOM, interpolation=cv2.INTER_NEAREST)


def _pixel(point: np.ndarray) -> tuple[int, int]:
    x, y = np.round((np.asarray(point) + 0.5) * ZOOM).astype(int)
    return int(x), int(y)
