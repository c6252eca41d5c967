"""Windows around the head, in head heights: cut out of a picture, evened out, and averaged over cells."""

from __future__ import annotations

import dataclasses
import math

import cv2
import numpy as np

from recognizer.person.head_shoulders import Body
from recognizer.video.shrinking import halved, halves


@dataclasses.dataclass(frozen=True)
class View:
    """A window around the head's centre, in head heights.

    Attributes:
        pixels: pixels of the window per head height.
        left, right, top, bottom: its borders [head heights from the head's centre].
    """

    pixels: int
    left: float
    right: float
    top: float
    bottom: float

    @property
    def size(self) -> tuple[int, int]:
        """Width and height [px]."""
        return round((self.right - self.left) * self.pixels), round((self.bottom - self.top) * self.pixels)

    def grid(self) -> tuple[np.ndarray, np.ndarray]:
        """Return x and y of every pixel's centre [head heights], two (h, w) float32."""
        width, height = self.size
        x = (np.arange(width, dtype=np.float32) + 0.5) / self.pixels + self.left
        y = (np.arange(height, dtype=np.float32) + 0.5) / self.pixels + self.top
        columns, rows = np.meshgrid(x, y)
        return columns, rows


WHOLE = View(8, -5.0, 5.0, -3.25, 4.75)  # arms at full reach
HEAD = View(24, -0.875, 0.875, -0.875, 0.875)  # fine enough to see a nod
POSE = View(16, -3.5, 3.5, -2.5, 3.0)  # fine enough to see which way a forearm points
ROWS, COLUMNS = 8, 10  # cells of one head height over the window WHOLE
GRID_X, GRID_Y = WHOLE.grid()


def in_view(body: Body, shape: tuple[int, ...]) -> np.ndarray:
    """1 where the window WHOLE shows the image (h, w), 0 beyond its border, (64, 80) float32.

    What a window repeats of a noisy border would seem to flow.
    """
    x, y = body.x + GRID_X * body.head, body.y + GRID_Y * body.head
    return ((x >= 0) & (x < shape[1]) & (y >= 0) & (y < shape[0])).astype(np.float32)


def cell_means(maps: np.ndarray, per_head: int = 1) -> np.ndarray:
    """Mean over each cell of maps (…, 64, 80): (…, 8, 10), or finer with several cells ``per_head`` height."""
    *lead, height, width = maps.shape
    rows, columns = ROWS * per_head, COLUMNS * per_head
    # One above the other they are one picture: cells do not reach across.
    stacked = np.asarray(maps, np.float32).reshape(-1, width)
    size = (columns, len(stacked) * rows // height)
    return cv2.resize(stacked, size, interpolation=cv2.INTER_AREA).reshape(*lead, rows, columns)


def cut_window(grey: np.ndarray, body: Body, view: View) -> np.ndarray:
    """Cut a window around the head out of a grey image, float32; beyond the border its edge is repeated."""
    scale = body.head / view.pixels
    width, height = view.size
    x, y = body.x + view.left * body.head, body.y + view.top * body.head
    left = top = 0
    unit = 2 ** (times := halves(scale))
    if times:  # so that nothing is skipped; only what the window shows
        left, right = _seen(x, width * scale, 2 * scale, grey.shape[1], unit)
        top, bottom = _seen(y, height * scale, 2 * scale, grey.shape[0], unit)
        grey = halved(grey[top:bottom, left:right], times)
    # OpenCV counts from the middle of the first pixel, the window from its border.
    step, column, row = scale / unit, (x + scale / 2 - left) / unit - 0.5, (y + scale / 2 - top) / unit - 0.5
    matrix = np.array([[step, 0, column], [0, step, row]], np.float32)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return cv2.warpAffine(grey, matrix, view.size, flags=flags, borderMode=cv2.BORDER_REPLICATE).astype(np.float32)


def _seen(start: float, length: float, margin: float, size: int, unit: int) -> tuple[int, int]:
    """First and last pixel (exclusive) of an image of ``size`` that a window needs: so many ``unit``, one at least."""
    first = min(max(0, int(np.floor(start - margin))), max(0, size - unit))
    last = min(size, int(np.ceil(start + length + margin)))
    return first, first + max(1, (last - first) // unit) * unit


def even_contrast(window: np.ndarray, sigma: float) -> np.ndarray:
    """Subtract the local mean and divide by the local deviation: light, shirts and exposure count less."""
    detail = window - smoothed(window, sigma)
    # Running sums of squares may end just below 0 where nothing varies.
    deviation = np.sqrt(np.maximum(smoothed(detail * detail, 1.5 * sigma), 0))
    return detail * (25.0 / (deviation + 6.0))


def smoothed(window: np.ndarray, sigma: float) -> np.ndarray:
    """The mean of the mean over a square: nearly a Gaussian of deviation ``sigma`` [px], in half its time."""
    side = 2 * round((math.sqrt(6 * sigma * sigma + 1) - 1) / 2) + 1
    return cv2.blur(cv2.blur(window, (side, side)), (side, side))
