"""Where is the person? A head-and-shoulders template over a pyramid of gradient orientations.

The outline of a head on shoulders is what people, clothes and rooms have in common. It is learned once, linearly
(:mod:`recognizer.finder_training`), and is shipped as a small table of weights; everything the recogniser measures
is then placed and scaled by the head (Dalal and Triggs, CVPR 2005, for the cells; the template is our own).
"""

from __future__ import annotations

import dataclasses
import functools
import math
from importlib.resources import files

import cv2
import numpy as np

HEAD = 6.0  # px: height of a head in the pyramid level where the template finds it
CELL = 2  # px
BINS = 6  # unsigned gradient orientations
CHANNELS = BINS + 1
WIDE, TALL = 13, 13  # cells of the template, 4.3 heads each way
HEAD_AT = (6.0, 4.0)  # column and row of the head's centre in the template [cells]
SMALLEST, LARGEST = 0.037, 0.5  # head heights searched, in image heights: a third of the image to close-up
STEP = 2 ** (1 / 4)  # ratio of neighbouring levels
FINE_HEAD = 9.0  # px: height of a head in the second, closer look
FINE = 20  # cells of the closer look, 4.4 heads each way
_FINE_RIM = 4  # cells around it, only for evening out the contrast
_WEIGHTS = "head_shoulders.npz"
_NEIGHBOURS = np.ones((3, 3), np.uint8)
_BIN_CENTRES = np.arange(BINS, dtype=np.float32)[:, None, None]
_HIGH = 0.9  # share of a level's places that are lower than any candidate


@dataclasses.dataclass(frozen=True)
class Body:
    """Place and size of a person in the image.

    Attributes:
        x, y: centre of the head [px].
        head: height of the head, chin to crown [px].
        score: how sure; above 0 is more likely a person than not.
    """

    x: float
    y: float
    head: float
    score: float


def cells(grey: np.ndarray) -> np.ndarray:
    """Orientation cells of a grey image: (rows, columns, 7) float32, contrast normalised.

    Six unsigned orientations and the gradient's magnitude, each the mean of a cell's pixels.
    """
    image = grey.astype(np.float32)
    gx = cv2.Sobel(image, cv2.CV_32F, 1, 0, ksize=1, borderType=cv2.BORDER_REPLICATE)
    gy = cv2.Sobel(image, cv2.CV_32F, 0, 1, ksize=1, borderType=cv2.BORDER_REPLICATE)
    energy = gx * gx + gy * gy
    scale = 1.0 / np.sqrt(cv2.blur(energy, (25, 25)) + 30.0)
    magnitude = np.sqrt(energy) * scale
    np.minimum(magnitude, 3.0, out=magnitude)
    angle = cv2.phase(gx, gy)
    np.multiply(angle, BINS / np.pi, out=angle)
    np.subtract(angle, BINS * (angle >= BINS).astype(np.float32), out=angle)
    rows, columns = (side // CELL for side in grey.shape)
    whole = slice(rows * CELL), slice(columns * CELL)
    planes = np.empty((CHANNELS, rows * CELL, columns * CELL), np.float32)
    shares = planes[:BINS]
    np.subtract(angle[whole], _BIN_CENTRES, out=shares)
    np.abs(shares, out=shares)
    # Only the first bin's neighbour lies beyond the end of the scale.
    np.subtract(BINS, shares[0], out=planes[BINS])
    np.minimum(shares[0], planes[BINS], out=shares[0])
    np.subtract(1.0, shares, out=shares)
    np.maximum(shares, 0.0, out=shares)
    np.multiply(shares, magnitude[whole], out=shares)
    planes[BINS] = magnitude[whole]
    # One above the other they are one picture: cells do not reach across.
    stacked = planes.reshape(-1, columns * CELL)
    means = cv2.resize(stacked, (columns, CHANNELS * rows), interpolation=cv2.INTER_AREA)
    return np.moveaxis(means.reshape(CHANNELS, rows, columns), 0, -1)


def levels(height: int, width: int) -> list[float]:
    """Head heights [px] of the pyramid levels of an image."""
    count = int(np.floor(np.log(LARGEST / SMALLEST) / np.log(STEP))) + 1
    return [height * SMALLEST * STEP**i for i in range(count)]


def pyramid(grey: np.ndarray) -> list[tuple[float, np.ndarray]]:
    """Return (head height [px of ``grey``], cells) of each level; the border is padded by half a template."""
    height, width = grey.shape
    out = []
    for head in levels(height, width):
        scale = HEAD / head
        size = (max(8, round(width * scale)), max(8, round(height * scale)))
        smaller = cv2.resize(grey, size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        out.append((head, cells(smaller)))
    return out


@functools.cache
def _stored() -> dict[str, np.ndarray]:
    with files("recognizer").joinpath(_WEIGHTS).open("rb") as file, np.load(file, allow_pickle=False) as stored:
        return {
            name: stored[name].astype(np.float64 if name.startswith("rank") else np.float32) for name in stored.files
        }


def template() -> tuple[np.ndarray, float]:
    """Return the shipped template, (13, 13, 7) weights and the offset."""
    return _stored()["weights"], float(_stored()["offset"])


def closer_template() -> tuple[np.ndarray, float]:
    """Return the weights (2800,) of the closer look and their offset."""
    return _stored()["fine_weights"].ravel(), float(_stored()["fine_offset"])


def ranking() -> tuple[np.ndarray, float]:
    """Return the shipped weights that choose among candidates, and their offset."""
    return _stored()["rank_weights"], float(_stored()["rank_offset"])


def score_maps(grey: np.ndarray, weights: np.ndarray, offset: float) -> list[tuple[float, np.ndarray]]:
    """Return (head height [px], score of each cell as the head's centre) for every level."""
    out = []
    for head, level in pyramid(grey):
        total = np.full(level.shape[:2], offset, np.float32)
        for c in range(CHANNELS):
            # Beyond the image nothing is known: constant zero borders.
            anchor = (int(HEAD_AT[0]), int(HEAD_AT[1]))
            plane = np.ascontiguousarray(level[:, :, c])
            total += cv2.filter2D(plane, cv2.CV_32F, weights[:, :, c], anchor=anchor, borderType=cv2.BORDER_CONSTANT)
        out.append((head, total))
    return out


def best_bodies(maps: list[tuple[float, np.ndarray]], size: tuple[int, int], count: int = 14) -> list[Body]:
    """Pick the highest, mutually distant scores; ``size`` is (width, height) of the image."""
    found: list[tuple[float, float, float, float]] = []
    for head, scores in maps:
        rank = int(_HIGH * (scores.size - 1))
        peaks = (scores >= cv2.dilate(scores, _NEIGHBOURS)) & (scores > np.partition(scores.ravel(), rank)[rank])
        rows, columns = np.nonzero(peaks)
        x = (columns + 0.5) * size[0] / scores.shape[1]
        y = (rows + 0.5) * size[1] / scores.shape[0]
        found += zip(scores[rows, columns].tolist(), x.tolist(), y.tolist(), [head] * len(x), strict=True)
    kept: list[Body] = []
    for score, px, py, head in sorted(found, key=lambda place: -place[0]):
        if len(kept) == count:
            break
        if not any(_overlap(px, py, head, other) for other in kept):
            kept.append(Body(px, py, head, score))
    return kept


def _overlap(x: float, y: float, head: float, other: Body) -> bool:
    """Same place and similar size; a face inside a head is another candidate."""
    near = math.hypot(x - other.x, y - other.y) < 0.7 * max(head, other.head)
    return near and abs(math.log(head / other.head)) < 0.4


def closer_look(grey: np.ndarray, bodies: list[Body]) -> np.ndarray:
    """Cells of a finer window around each candidate, (n, 2800) float32."""
    return np.array([_fine_cells(grey, body) for body in bodies], np.float32).reshape(-1, FINE * FINE * CHANNELS)


def _fine_cells(grey: np.ndarray, body: Body) -> np.ndarray:
    side = (FINE + 2 * _FINE_RIM) * CELL
    scale = body.head / FINE_HEAD
    # The head's centre stands where it stands in the coarse template.
    left = body.x - (HEAD_AT[0] + 0.5) / WIDE * FINE * CELL * scale - _FINE_RIM * CELL * scale
    top = body.y - (HEAD_AT[1] + 0.5) / TALL * FINE * CELL * scale - _FINE_RIM * CELL * scale
    size = max(2, round(side * scale))
    crop = cv2.warpAffine(
        grey, np.array([[1, 0, left], [0, 1, top]], np.float32), (size, size),
        flags=cv2.INTER_NEAREST | cv2.WARP_INVERSE_MAP, borderMode=cv2.BORDER_REPLICATE,
    )  # fmt: skip
    window = cv2.resize(crop, (side, side), interpolation=cv2.INTER_AREA if scale > 1 else cv2.INTER_LINEAR)
    return cells(window)[_FINE_RIM:-_FINE_RIM, _FINE_RIM:-_FINE_RIM].ravel()
