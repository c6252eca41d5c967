"""Pictures of every intermediate stage of an answer, as the thesis's figures show them (S8-S14)."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from recognizer.errors import RecognizerError
from recognizer.recognition import Evidence, Recognition
from recognizer.thesis.difference_images import Ellipse
from recognizer.thesis.key_frames import intersection_curve

GREEN, WHITE, RED, YELLOW = (0, 220, 0), (255, 255, 255), (60, 60, 255), (0, 220, 255)
SHOWN = 8  # pictures in a strip


def draw_boxes(image: np.ndarray, boxes: np.ndarray) -> np.ndarray:
    """Draw the green rectangles of fig. 3-3 on a copy; boxes (n, 4) as fractions of the image."""
    out = image.copy()
    height, width = out.shape[:2]
    for x, y, w, h in boxes * [width, height, width, height]:
        cv2.rectangle(out, (round(x), round(y)), (round(x + w), round(y + h)), GREEN, 2)
    return out


def draw_ellipses(image: np.ndarray, ellipses: list[Ellipse]) -> np.ndarray:
    """Draw the white ellipses of fig. 2-5 on a copy."""
    out = image.copy() if image.ndim == 3 else cv2.cvtColor(image, cv2.COLOR_GRAY2BGR)
    height, width = out.shape[:2]
    for e in ellipses:
        centre, axes = (round(e.x * width), round(e.y * height)), (round(2 * e.sx * width), round(2 * e.sy * height))
        cv2.ellipse(out, centre, axes, 0, 0, 360, WHITE, 2, cv2.LINE_AA)
    return out


def draw_path(image: np.ndarray, path: np.ndarray) -> np.ndarray:
    """Draw the path of the centroid of motion, from green to red, on a copy; path (n, 2) as fractions."""
    out = image.copy()
    height, width = out.shape[:2]
    points = np.round(path[np.isfinite(path).all(axis=1)] * [width, height]).astype(int)
    for i in range(1, len(points)):
        share = i / len(points)
        colour = (60, round(220 * (1 - share)), round(255 * share))
        cv2.line(out, points[i - 1].tolist(), points[i].tolist(), colour, 2, cv2.LINE_AA)
    return out


def explain(recognition: Recognition, folder: Path) -> list[Path]:
    """Write the stages of an answer as numbered PNG files and return their paths.

    Raises:
        RecognizerError: the answer carries no evidence, or the folder cannot be written.
    """
    evidence = recognition.evidence
    if evidence is None:
        raise RecognizerError(f"{recognition.source}: this answer has no evidence to draw")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise RecognizerError(f"cannot write {folder}: {error.strerror}; choose another place") from None
    stages = {
        "1_intersection_curve": _curve(evidence),
        "2_key_frames": _strip(evidence.key_images),
        "3_difference_images": _strip(evidence.difference_images),
        "4_ellipses": _strip(
            [draw_ellipses(d, e) for d, e in zip(evidence.difference_images, evidence.ellipses, strict=True)]
        ),
        "5_flow_boxes": _strip(
            [draw_boxes(evidence.samples[i].image, evidence.boxes[i]) for i in _spread(len(evidence.samples))]
        ),
        "6_centroid_path": draw_path(evidence.samples[-1].image, evidence.centroid_path),
    }
    if evidence.body is not None:
        stages["7_body"] = _body(evidence)
    paths = []
    for name, picture in stages.items():
        path = folder / f"{name}.png"
        if not cv2.imwrite(str(path), picture):
            raise RecognizerError(f"cannot write {path}; choose another place")
        paths.append(path)
    return paths


def _spread(n: int) -> list[int]:
    return np.unique(np.linspace(0, n - 1, SHOWN).round().astype(int)).tolist()


def _strip(images: list[np.ndarray]) -> np.ndarray:
    colour = [cv2.cvtColor(i, cv2.COLOR_GRAY2BGR) if i.ndim == 2 else i for i in images]
    return np.hstack([cv2.copyMakeBorder(i, 2, 2, 2, 2, cv2.BORDER_CONSTANT, value=WHITE) for i in colour])


def _curve(evidence: Evidence) -> np.ndarray:
    """Histogram intersection against time, key frames marked (fig. 2-1)."""
    curve = intersection_curve([sample.grey for sample in evidence.samples])
    width, height = 640, 240
    out = np.full((height, width, 3), 255, np.uint8)
    x = np.linspace(20, width - 20, len(curve))
    y = height - 20 - (curve - curve.min()) / max(np.ptp(curve), 1e-9) * (height - 40)
    cv2.polylines(out, [np.column_stack([x, y]).round().astype(np.int32)], False, (120, 60, 0), 2, cv2.LINE_AA)
    frames = [sample.index for sample in evidence.samples]
    for key in evidence.key_frames[:2]:
        i = frames.index(key)
        cv2.circle(out, (round(x[i]), round(y[i])), 6, RED, -1, cv2.LINE_AA)
    cv2.putText(out, "histogram intersection; red: least correlated pair", (20, 16), 0, 0.45, (0, 0, 0), 1, cv2.LINE_AA)
    return out


def _body(evidence: Evidence) -> np.ndarray:
    """The head that was found and the window that motion is measured in."""
    from recognizer.person.view import WHOLE

    body = evidence.body
    assert body is not None
    out = evidence.samples[0].image.copy()
    for left, top, right, bottom, colour in (
        (-0.4, -0.5, 0.4, 0.5, GREEN),
        (WHOLE.left, WHOLE.top, WHOLE.right, WHOLE.bottom, YELLOW),
    ):
        first = (round(body.x + left * body.head), round(body.y + top * body.head))
        last = (round(body.x + right * body.head), round(body.y + bottom * body.head))
        cv2.rectangle(out, first, last, colour, 2)
    return out
