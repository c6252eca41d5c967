"""Where are the raised hands of a person in view? A linear template over windows, off the head and within its reach.

The head comes first (`recognizer.person.head_shoulders`): it says how large hands are, where they can be and what
colour skin is. Some of the places that look like a head are tried, and head and hand are chosen together.
"""

from __future__ import annotations

import functools
from dataclasses import dataclass
from importlib.resources import files

import cv2
import numpy as np

from recognizer.person.closer_look import closer_score
from recognizer.person.head_fit import fit
from recognizer.person.head_shoulders import CELL, Body, best_bodies, closer_look, score_maps, template
from recognizer.postures.person import windows
from recognizer.postures.types import Floats, Image

SEARCH_ROWS = 240  # rows at which the head is looked for
HEADS = 3  # places like a head that are tried
HEAD_SHARE = (0.09, 0.27)  # height of a head in picture heights: smaller is noise, larger is no person in view
HAND = 0.88  # length of a hand over the height of a head as the finder measures it
SIZES = (0.84, 1.0, 1.19)  # times that length
REACH = (2.8, 1.3, 1.5)  # heads sideways, up and down from the head's centre where a raised hand can be
OFF_HEAD = (0.45, 0.7)  # half axes, in heads, of the ellipse that is head and neck
FACE = (0.22, 0.3)  # half axes, in heads, of what is skin of the face
HEAD_COUNTS = 0.3  # of the head's score in a hand's
APART = 0.3  # hand lengths: places nearer than this are one
MOST = 12
_TEMPLATE = "hand_template.npz"


@dataclass(frozen=True)
class Spot:
    """A place that looks like a raised hand."""

    x: float  # pixels of the photo: the middle finger's knuckle
    y: float
    hand: float  # length of the hand, wrist to fingertips, pixels of the photo
    score: float  # above 0 is more like a hand than not; with a share of the head's score
    face: Floats  # (3,) Lab colour of the face it belongs to

    @property
    def middle(self) -> Floats:
        """(2,) x, y."""
        return np.array([self.x, self.y])


@functools.cache
def hand_template() -> tuple[np.ndarray, float]:
    """Return the template (12, 12, 15) and its offset, as `training.hand_finder_training` learns it."""
    with (
        files("recognizer.postures.person").joinpath(_TEMPLATE).open("rb") as file,
        np.load(file, allow_pickle=False) as stored,
    ):
        return stored["weights"].astype(np.float32), float(stored["offset"])


def find_heads(bgr: Image, count: int = HEADS) -> list[Body]:
    """Return the places most like a head on shoulders, best first, in pixels of the photo."""
    grey = cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)
    scale = min(1.0, SEARCH_ROWS / grey.shape[0])
    small = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1 else grey
    low, high = (share * small.shape[0] for share in HEAD_SHARE)
    maps = [(head, scores) for head, scores in score_maps(small, *template()) if low <= head <= high]
    found = best_bodies(maps, (small.shape[1], small.shape[0]))
    if not found:
        return []
    closer = np.tanh(closer_score(closer_look(small, found)) / 2)  # -1 for none, 1 for a head, as the template's aim
    exact = [fit(small, body) for body in found]
    bodies = [
        Body(b.x / scale, b.y / scale, b.head / scale, float(b.score + c)) for b, c in zip(exact, closer, strict=True)
    ]
    return sorted(bodies, key=lambda body: -body.score)[:count]


def find_hands(bgr: Image, heads: list[Body]) -> list[Spot]:
    """Return the places most like a raised hand of whoever has one of the heads, best first."""
    spots = [spot for head in heads for spot in search(bgr, head, *hand_template())]
    return distinct(spots)


def face_colour(bgr: Image, head: Body) -> Floats:
    """Return the median Lab colour, (3,), of a head's middle."""
    half = np.array(FACE) * head.head
    left, top = (max(0, int(v)) for v in (head.x - half[0], head.y - half[1]))
    part = bgr[top : int(head.y + half[1]) + 2, left : int(head.x + half[0]) + 2]
    if part.size == 0:
        return np.array([60.0, 15.0, 15.0])
    rows, columns = np.indices(part.shape[:2])
    inside = ((columns + left - head.x) / half[0]) ** 2 + ((rows + top - head.y) / half[1]) ** 2 < 1
    colours = windows.lab(cv2.GaussianBlur(part, (0, 0), 0.8))
    chosen = colours[inside] if inside.any() else colours.reshape(-1, 3)
    return np.median(chosen, axis=0).astype(np.float64)


def search(bgr: Image, head: Body, template_weights: np.ndarray, offset: float) -> list[Spot]:
    """Return the peaks of a template (12, 12, 15) within a head's reach, best first."""
    face = face_colour(bgr, head)
    x, y = (max(0, int(v)) for v in (head.x - (REACH[0] + 1) * head.head, head.y - (REACH[1] + 1) * head.head))
    right, below = head.x + (REACH[0] + 1) * head.head, head.y + (REACH[2] + 1) * head.head
    part = bgr[y : int(below) + 1, x : int(right) + 1]
    if min(part.shape[:2]) < CELL:
        return []
    spots: list[Spot] = []
    for size in SIZES:
        hand = HAND * head.head * size
        scores, fx, fy = _scores(part, face, hand, template_weights, offset)
        rows, columns = np.nonzero(scores >= cv2.dilate(scores, np.ones((3, 3), np.uint8)))
        xs, ys = (columns * CELL - windows.CELLS) * fx + x, (rows * CELL - windows.CELLS) * fy + y
        near = _within_reach(xs, ys, head) & (xs >= 0) & (ys >= 0) & (xs < bgr.shape[1]) & (ys < bgr.shape[0])
        values = scores[rows, columns] + HEAD_COUNTS * head.score
        spots += [
            Spot(float(px), float(py), hand, float(value), face)
            for px, py, value in zip(xs[near], ys[near], values[near], strict=True)
        ]
    return distinct(spots)


def _scores(
    part: Image, face: Floats, hand: float, template_weights: np.ndarray, offset: float
) -> tuple[np.ndarray, float, float]:
    """Return the template's score at each cell, and the photo's pixels per pixel searched, both ways."""
    scale = windows.HAND / hand
    width, height = (max(CELL, round(n * scale)) for n in part.shape[1::-1])
    rim = windows.CELLS
    small = cv2.resize(part, (width, height), interpolation=cv2.INTER_AREA if scale < 1 else cv2.INTER_LINEAR)
    small = cv2.copyMakeBorder(small, rim, rim, rim, rim, cv2.BORDER_REPLICATE)
    planes = windows.channels(small, windows.like_face(windows.lab(small), face))
    total = np.full(planes.shape[:2], offset, np.float32)
    anchor = (windows.CELLS // 2, windows.CELLS // 2)
    for c in range(windows.CHANNELS):
        plane, kernel = np.ascontiguousarray(planes[:, :, c]), np.ascontiguousarray(template_weights[:, :, c])
        total += cv2.filter2D(plane, cv2.CV_32F, kernel, anchor=anchor, borderType=cv2.BORDER_CONSTANT)
    return total, part.shape[1] / width, part.shape[0] / height


def _within_reach(xs: np.ndarray, ys: np.ndarray, head: Body) -> np.ndarray:
    aside, down = (xs - head.x) / head.head, (ys - head.y) / head.head
    off_head = (aside / OFF_HEAD[0]) ** 2 + (down / OFF_HEAD[1]) ** 2 > 1
    return np.asarray(off_head & (np.abs(aside) < REACH[0]) & (down > -REACH[1]) & (down < REACH[2]))


def distinct(spots: list[Spot]) -> list[Spot]:
    """Return the best of spots that are mutually apart, best first."""
    kept: list[Spot] = []
    for spot in sorted(spots, key=lambda s: -s.score):
        if all(np.hypot(spot.x - k.x, spot.y - k.y) > APART * spot.hand for k in kept):
            kept.append(spot)
            if len(kept) == MOST:
                break
    return kept
