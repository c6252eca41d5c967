"""Where is the person? A head-and-shoulders template over a pyramid of gradient orientations.

The outline of a head on shoulders is what people, clothes and rooms have in common. It is learned once, linearly
(:mod:`recognizer.person.training.finder_training`), and is shipped as a small table of weights; everything the
recogniser measures is then placed and scaled by the head (Dalal and Triggs, CVPR 2005, for the cells; the template is
our own).
"""

from __future__ import annotations

import dataclasses
import functools
import math
from importlib.resources import files

import cv2
import numpy as np
from scipy import fft

from recognizer.video.shrinking import halved, halves

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
_HIGH = 0.9  # share of a level's places that are lower than any candidate


def _shares() -> np.ndarray:
    """How much of a gradient goes to each bin, (6, 256), by its orientation in 256 steps: the two nearest share it."""
    away = np.abs((np.arange(256) + 0.5) * (BINS / 256) - np.arange(BINS)[:, None])
    return np.maximum(0.0, 1.0 - np.minimum(away, BINS - away)).astype(np.float32)


_SHARES = _shares()


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
    magnitude = np.sqrt(energy / (cv2.blur(energy, (25, 25)) + 30.0))
    rows, columns = (side // CELL for side in grey.shape)
    whole = slice(rows * CELL), slice(columns * CELL)
    planes = np.empty((CHANNELS, rows * CELL, columns * CELL), np.float32)
    np.minimum(magnitude[whole], 3.0, out=planes[BINS])
    # Half a turn in 256 steps; the other half has the same orientations.
    angle = (cv2.phase(gx, gy)[whole] * np.float32(256 / np.pi)).astype(np.int32).astype(np.uint8)
    for shares, plane in zip(_SHARES, planes[:BINS], strict=True):
        cv2.multiply(cv2.LUT(angle, shares), planes[BINS], dst=plane)
    # One above the other they are one picture: cells do not reach across.
    stacked = planes.reshape(-1, columns * CELL)
    means = cv2.resize(stacked, (columns, CHANNELS * rows), interpolation=cv2.INTER_AREA)
    return np.moveaxis(means.reshape(CHANNELS, rows, columns), 0, -1)


def levels(height: int, width: int) -> list[float]:
    """Head heights [px] of the pyramid levels of an image."""
    count = int(np.floor(np.log(LARGEST / SMALLEST) / np.log(STEP))) + 1
    return [height * SMALLEST * STEP**i for i in range(count)]


def pyramid(grey: np.ndarray) -> list[tuple[float, np.ndarray]]:
    """Return (head height [px of ``grey``], cells) of each level."""
    height, width = grey.shape
    out = []
    source = grey
    for head in levels(height, width):
        scale = HEAD / head
        size = (max(8, round(width * scale)), max(8, round(height * scale)))
        # The small ones are made from a picture at most four times their size, which is soon looked through.
        if size[0] * 4 <= source.shape[1] and size[1] * 4 <= source.shape[0]:
            source = cv2.resize(source, None, fx=0.5, fy=0.5, interpolation=cv2.INTER_AREA)
        smaller = cv2.resize(source, size, interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
        out.append((head, cells(smaller)))
    return out


@functools.cache
def _stored() -> dict[str, np.ndarray]:
    with files("recognizer.person").joinpath(_WEIGHTS).open("rb") as file, np.load(file, allow_pickle=False) as stored:
        return {name: stored[name].astype(np.float32) for name in stored.files}


def template() -> tuple[np.ndarray, float]:
    """Return the shipped template, (13, 13, 7) weights and the offset."""
    return _stored()["weights"], float(_stored()["offset"])


def score_maps(grey: np.ndarray, weights: np.ndarray, offset: float) -> list[tuple[float, np.ndarray]]:
    """Return (head height [px], score of each cell as the head's centre) for every level.

    Beyond the image nothing is known: zeros.
    """
    out = []
    for head, level in pyramid(grey):
        rows, columns = level.shape[:2]
        shape = (fft.next_fast_len(rows + TALL - 1, True), fft.next_fast_len(columns + WIDE - 1, True))
        # One transform back serves all channels: correlation is a product of spectra, and they add up.
        spectrum = fft.rfft2(np.moveaxis(level, -1, 0), shape) * _spectrum(weights.tobytes(), shape)
        scores = fft.irfft2(spectrum.sum(axis=0), shape)
        centred = np.roll(scores, (int(HEAD_AT[1]), int(HEAD_AT[0])), axis=(0, 1))
        out.append((head, centred[:rows, :columns] + np.float32(offset)))
    return out


@functools.lru_cache(maxsize=64)
def _spectrum(weights: bytes, shape: tuple[int, int]) -> np.ndarray:
    """Spectrum of a template's channels (7, …), as correlation needs it."""
    planes = np.frombuffer(weights, np.float32).reshape(TALL, WIDE, CHANNELS)
    return np.conj(fft.rfft2(np.moveaxis(planes, -1, 0), shape))


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
    times = max(0, halves(scale) - 1)  # the rest by area
    size = max(1, round(side * scale / 2**times)) * 2**times
    crop = halved(_square(grey, round(left), round(top), max(2, size)), times)
    window = cv2.resize(crop, (side, side), interpolation=cv2.INTER_AREA if scale > 1 else cv2.INTER_LINEAR)
    return cells(window)[_FINE_RIM:-_FINE_RIM, _FINE_RIM:-_FINE_RIM].ravel()


def _square(grey: np.ndarray, left: int, top: int, size: int) -> np.ndarray:
    """A square part of a picture; beyond the border its edge is repeated."""
    height, width = grey.shape
    # At least a row and a column of the picture, however far away the square is.
    first_row, last_row = min(max(top, 0), height - 1), max(min(top + size, height), 1)
    first_column, last_column = min(max(left, 0), width - 1), max(min(left + size, width), 1)
    part = grey[first_row:last_row, first_column:last_column]
    if part.shape == (size, size):
        return part
    above, before = (min(max(missing, 0), size - 1) for missing in (first_row - top, first_column - left))
    below, after = size - above - part.shape[0], size - before - part.shape[1]
    return cv2.copyMakeBorder(part, above, below, before, after, cv2.BORDER_REPLICATE)
