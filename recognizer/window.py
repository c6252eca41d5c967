"""The person in a window of his own size: flow in head heights per second, whatever the camera."""

from __future__ import annotations

import dataclasses
import math

import cv2
import numpy as np

from recognizer.finder import Body
from recognizer.flow import horn_schunck
from recognizer.head_follow import displacement
from recognizer.samples import Sample
from recognizer.shrinking import halved, halves

LEVELS, ITERATIONS, ALPHA = 3, 12, 6.0


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
STILL = 0.35  # head heights per second: slower is sway or noise
ROWS, COLUMNS = 8, 10  # cells of one head height over the window WHOLE
GRID_X, GRID_Y = WHOLE.grid()
_CHEST = (np.abs(GRID_X) < 0.7) & (GRID_Y > 1.3) & (GRID_Y < 3.0)
_TORSO = (_CHEST / _CHEST.sum()).ravel().astype(np.float32)


@dataclasses.dataclass(frozen=True)
class Step:
    """What one sample shows of the person since the sample before.

    Attributes:
        time: seconds.
        seconds: since the sample before.
        picture: (64, 80) float32, the window with its contrast evened out.
        flow: (2, 64, 80) velocity right and down in the window WHOLE [head heights per second], 0 where slower
            than STILL and beyond the image's border.
        speed: (64, 80) its magnitude.
        ways: (4, 8, 10) motion right, left, down and up, mean over cells of one head height.
        torso: (2,) mean velocity of chest and belly, slow motion included.
        head_flow: (2, 42, 42) velocity in the window HEAD, which follows the head, slow motion included.
        pose: (88, 112) uint8, the window POSE as the camera saw it.
        place: (2,) of the head, right and down from the person's place [head heights].
    """

    time: float
    seconds: float
    picture: np.ndarray
    flow: np.ndarray
    speed: np.ndarray
    ways: np.ndarray
    torso: np.ndarray
    head_flow: np.ndarray
    pose: np.ndarray
    place: np.ndarray


class Windows:
    """Turns samples into steps, one by one, once the body is known."""

    def __init__(self, body: Body) -> None:
        self.body = body
        self._before: tuple[float, np.ndarray, np.ndarray, Body] | None = None
        self._inside: np.ndarray | None = None

    def push(self, sample: Sample, head: Body) -> Step | None:
        """Take the next sample, in which the head is at ``head``; the first gives no step."""
        whole = even_contrast(cut_window(sample.grey, self.body, WHOLE), WHOLE.pixels / 2)
        face = even_contrast(cut_window(sample.grey, head, HEAD), HEAD.pixels / 4)
        before, self._before = self._before, (sample.time, whole, face, head)
        if before is None or self._inside is None:
            self._inside = in_view(self.body, sample.grey.shape)
            return None
        seconds = sample.time - before[0]
        flow = np.stack(coarse_to_fine(before[1], whole)) * (self._inside / np.float32(WHOLE.pixels * seconds))
        head_flow = np.stack(coarse_to_fine(before[2], face)) / np.float32(HEAD.pixels)
        head_flow += displacement(before[3], head)[:, None, None]  # the window's own way
        pose = cut_window(sample.grey, self.body, POSE).astype(np.uint8)
        place = displacement(self.body, head)
        return make_step(sample.time, seconds, whole, flow, head_flow / np.float32(seconds), pose, place)


def in_view(body: Body, shape: tuple[int, ...]) -> np.ndarray:
    """1 where the window WHOLE shows the image (h, w), 0 beyond its border, (64, 80) float32.

    What a window repeats of a noisy border would seem to flow.
    """
    x, y = body.x + GRID_X * body.head, body.y + GRID_Y * body.head
    return ((x >= 0) & (x < shape[1]) & (y >= 0) & (y < shape[0])).astype(np.float32)


def make_step(
    time: float,
    seconds: float,
    picture: np.ndarray,
    flow: np.ndarray,
    head_flow: np.ndarray,
    pose: np.ndarray,
    place: np.ndarray,
) -> Step:
    """Work out the rest of a step from its flow, as it is measured."""
    speed = np.sqrt(flow[0] * flow[0] + flow[1] * flow[1])
    torso = flow.reshape(2, -1) @ _TORSO
    moving = (speed > STILL).astype(np.float32)
    flow, speed = flow * moving, speed * moving
    ways = np.stack([np.maximum(f, 0) for f in (flow[0], -flow[0], flow[1], -flow[1])])
    return Step(time, seconds, picture, flow, speed, cell_means(ways), torso, head_flow, pose, place)


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


def coarse_to_fine(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Horn-Schunck from a quarter of the size upwards, each level refining what the coarser one found [px].

    A waving hand moves several pixels between samples, which one level alone cannot follow.
    """
    pairs = [(first, second)]
    for _ in range(LEVELS - 1):
        pairs.append((cv2.pyrDown(pairs[-1][0]), cv2.pyrDown(pairs[-1][1])))
    u, v = horn_schunck(*pairs[-1], ALPHA, ITERATIONS)
    for a, b in reversed(pairs[:-1]):
        height, width = a.shape
        u, v = cv2.resize(u, (width, height)) * 2, cv2.resize(v, (width, height)) * 2
        columns, rows = _grid(width, height)
        moved = cv2.remap(b, columns + u, rows + v, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
        du, dv = horn_schunck(a, moved, ALPHA, ITERATIONS)
        u, v = u + du, v + dv
    return u, v


_grids: dict[tuple[int, int], tuple[np.ndarray, np.ndarray]] = {}


def _grid(width: int, height: int) -> tuple[np.ndarray, np.ndarray]:
    if (width, height) not in _grids:
        columns, rows = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
        _grids[width, height] = (columns, rows)
    return _grids[width, height]
