"""The person in a window of his own size: flow in head heights per second, whatever the camera."""

from __future__ import annotations

import dataclasses

import cv2
import numpy as np

from recognizer.finder import Body
from recognizer.flow import horn_schunck
from recognizer.head_follow import displacement
from recognizer.samples import Sample

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
            than STILL.
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

    def push(self, sample: Sample, head: Body) -> Step | None:
        """Take the next sample, in which the head is at ``head``; the first gives no step."""
        whole = even_contrast(cut_window(sample.grey, self.body, WHOLE), WHOLE.pixels / 2)
        face = even_contrast(cut_window(sample.grey, head, HEAD), HEAD.pixels / 4)
        before, self._before = self._before, (sample.time, whole, face, head)
        if before is None:
            return None
        seconds = sample.time - before[0]
        flow = np.stack(coarse_to_fine(before[1], whole)) / np.float32(WHOLE.pixels * seconds)
        head_flow = np.stack(coarse_to_fine(before[2], face)) / np.float32(HEAD.pixels)
        head_flow += displacement(before[3], head)[:, None, None]  # the window's own way
        pose = cut_window(sample.grey, self.body, POSE).astype(np.uint8)
        place = displacement(self.body, head)
        return make_step(sample.time, seconds, whole, flow, head_flow / np.float32(seconds), pose, place)


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
    if scale > 1.5:  # shrink by area first, so that nothing is skipped; only what the window shows
        left, right = _seen(x, width * scale, 2 * scale, grey.shape[1])
        top, bottom = _seen(y, height * scale, 2 * scale, grey.shape[0])
        size = (max(1, round((right - left) / scale)), max(1, round((bottom - top) / scale)))
        fx, fy = size[0] / (right - left), size[1] / (bottom - top)
        grey = cv2.resize(grey[top:bottom, left:right], size, interpolation=cv2.INTER_AREA)
        matrix = np.array([[scale * fx, 0, (x - left) * fx], [0, scale * fy, (y - top) * fy]], np.float32)
    else:
        matrix = np.array([[scale, 0, x], [0, scale, y]], np.float32)
    flags = cv2.INTER_LINEAR | cv2.WARP_INVERSE_MAP
    return cv2.warpAffine(grey, matrix, view.size, flags=flags, borderMode=cv2.BORDER_REPLICATE).astype(np.float32)


def _seen(start: float, length: float, margin: float, size: int) -> tuple[int, int]:
    """First and last pixel (exclusive) of an image of ``size`` that a window needs, one at least."""
    first = min(max(0, int(np.floor(start - margin))), size - 1)
    return first, max(first + 1, min(size, int(np.ceil(start + length + margin))))


def even_contrast(window: np.ndarray, sigma: float) -> np.ndarray:
    """Subtract the local mean and divide by the local deviation: light, shirts and exposure count less."""
    detail = window - cv2.GaussianBlur(window, (0, 0), sigma)
    deviation = np.sqrt(cv2.GaussianBlur(detail * detail, (0, 0), 1.5 * sigma))
    return detail * (25.0 / (deviation + 6.0))


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
