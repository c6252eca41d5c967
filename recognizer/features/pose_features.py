"""What the person's pose is while moving: where they differ from rest, and which way the edges there run.

Flow says how something moves; a hand that rests at an ear and one that is held up differ in where it came to.
"""

from __future__ import annotations

from collections.abc import Iterator

import cv2
import numpy as np

from recognizer.features.phases import Active
from recognizer.person.view import POSE, cell_means

CHANGED = 18.0  # even-contrast levels between two pictures that count as changed
HELD = 14.0  # the same between means of several pictures, which are less noisy
HOLD_STEPS = 5  # half a second
DIRECTIONS = 4  # of edges, without sign
_DIRECTIONS = np.arange(DIRECTIONS, dtype=np.float32)[:, None, None]
MOMENTS = (("quarter", 0.25), ("middle", 0.5), ("late", 0.75))  # of the active part
Item = tuple[str, np.ndarray]


def pose_features(active: Active) -> Iterator[Item]:
    """Describe poses of the active part against each other and against the rest before it."""
    yield from _changes(active)
    rest = slice(max(0, active.first - 2), active.first + 1)
    standing = active.pictures[rest].mean(axis=0)
    held = _held_longest(active, standing)
    yield "changed_hold", cell_means(np.abs(active.pictures[held].mean(axis=0) - standing) > HELD, 2)
    before = levelled(active.poses[rest].mean(axis=0, dtype=np.float32))
    yield "edges_hold", new_edges(before, levelled(active.poses[held].mean(axis=0, dtype=np.float32)))
    for name, share in MOMENTS:
        at = active.first + round(share * (active.last - active.first))
        now = active.poses[max(0, at - 1) : at + 2].mean(axis=0, dtype=np.float32)
        yield f"edges_{name}", _coarser(new_edges(before, levelled(now)))


def _changes(active: Active) -> Iterator[Item]:
    """Share of each cell that changed between moments of the active part: the body's pose, held or not."""
    a, b = active.first, active.last - 1
    middle, early, late = (a + b) // 2, (3 * a + b) // 4, (a + 3 * b) // 4
    moments = {"half": (a, middle), "end": (a, b), "second": (middle, b), "early": (a, early), "late": (a, late)}
    first, second = (active.pictures[list(places)] for places in zip(*moments.values(), strict=True))
    cells = cell_means(np.abs(first - second) > CHANGED)
    yield from zip((f"changed_{name}" for name in moments), cells, strict=True)


def _held_longest(active: Active, standing: np.ndarray) -> slice:
    """Steps around the moment that is, for half a second, furthest from the pose at rest."""
    away = np.array([cv2.norm(p, standing, cv2.NORM_L1) for p in active.pictures[active.first : active.last]])
    middle = active.first + int(np.argmax(np.convolve(away, np.ones(HOLD_STEPS), "same")[: len(away)]))
    half = HOLD_STEPS // 2
    return slice(max(active.first, middle - half), min(active.last, middle + half + 1))


def levelled(picture: np.ndarray) -> np.ndarray:
    """Even out the contrast of a window POSE, (88, 112) float32, over a head height."""
    side = POSE.pixels + 1
    detail = picture - cv2.blur(picture, (side, side))
    # Running sums of squares may end just below 0 where nothing varies.
    deviation = np.sqrt(np.maximum(cv2.blur(detail * detail, (side, side)), 0))
    levelled_picture: np.ndarray = detail * (25.0 / (deviation + 6.0))
    return levelled_picture


def new_edges(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    """Edges of the picture ``after`` where it differs from ``before``.

    Args:
        before, after: (88, 112) float32, windows POSE, levelled.

    Returns:
        (4, 11, 14) mean strength of edges whose gradient points right, down-right, down and down-left (or the
        opposite way), in cells of half a head height.
    """
    change = cv2.GaussianBlur(cv2.absdiff(before, after), (0, 0), POSE.pixels / 8)
    gx, gy = cv2.Sobel(after, cv2.CV_32F, 1, 0, ksize=3), cv2.Sobel(after, cv2.CV_32F, 0, 1, ksize=3)
    strength, angle = cv2.cartToPolar(gx, gy)
    strength *= np.minimum(change * (0.5 / HELD), 1.0) * (1 / 80)
    angle *= DIRECTIONS / np.pi
    angle -= DIRECTIONS * (angle >= DIRECTIONS).astype(np.float32)  # half way round is the same direction
    apart = np.abs(angle - _DIRECTIONS)
    np.minimum(apart[0], DIRECTIONS - apart[0], out=apart[0])  # only the first one's neighbour lies beyond the end
    np.subtract(1, apart, out=apart)
    np.maximum(apart, 0, out=apart)
    apart *= strength
    # One above the other they are one picture: cells do not reach across.
    height, width = before.shape
    rows, columns = 2 * height // POSE.pixels, 2 * width // POSE.pixels
    stacked = apart.reshape(-1, width)
    cells = cv2.resize(stacked, (columns, DIRECTIONS * rows), interpolation=cv2.INTER_AREA)
    return cells.reshape(DIRECTIONS, rows, columns)


def _coarser(cells: np.ndarray) -> np.ndarray:
    """Cells of one head height, without the top row of half a head: (4, 11, 14) to (4, 5, 7)."""
    below = cells[:, 1:]
    directions, rows, columns = below.shape
    coarse: np.ndarray = below.reshape(directions, rows // 2, 2, columns // 2, 2).mean(axis=(2, 4))
    return coarse
