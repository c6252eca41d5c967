"""A whole person in view: the head is found first, and hands are looked for off it, at the size that it tells.

Skin is what is coloured like the face; the palm is the widest place near the upper end of what stands out as skin.
There a window as large as a hand is cut out, and the hand in it is divided from what is around it by local contrast,
so that a sleeve or a skin-coloured wall elsewhere in the room does not matter.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.finder import Body, best_bodies, score_maps, template
from recognizer.static.contrast import divide
from recognizer.static.palm import HandFrame, hand_frames
from recognizer.static.skin import gray_world, skin_mask
from recognizer.static.types import Floats, Image, Mask

SEARCH_ROWS = 240  # rows at which the head is looked for
SURE = 0.4  # score of the template from which a head is believed
CERTAIN = 1.0  # score from which it is no part of a close-up that happens to look like a head
HEAD_SHARE = (0.09, 0.27)  # height of a head in picture heights: smaller is noise, larger is no person in view
HAND = 0.95  # length of a hand over the height of a head as the finder measures it
REACH = (2.5, 0.7, 1.0)  # heads sideways, up and down from the head's centre where a raised hand can be
OFF_HEAD = (0.55, 0.8)  # half axes, in heads, of the ellipse that is head and neck
PALM = 0.15  # hand lengths: the blur at which a palm stands out
LEAST_CONTRAST = 0.08
SAME = 0.25  # hand lengths: palms nearer than this are one
MOST = 12
LIKE_FACE = (1.0, 2.5)  # distances in colour from the face that are tried as skin
SMALLEST = 36  # pixels of a hand's length: below, fingers are some three pixels wide
WINDOW = 1.6  # hand lengths: side of what is cut out around a hand
WINDOW_SIDE = 200  # pixels it is enlarged to
CORE = 0.09  # hand lengths around the palm's middle that are hand for sure
# What a hand is like at the size that the head tells: palm radius in hand lengths, share of the window that it fills
# (with some forearm), and how far the palm may be from where it was looked for, in hand lengths.
PALM_RADIUS = (0.12, 0.3)
FILLED = (0.06, 0.25)
STRAYED = 0.25
UPRIGHT = np.radians(70)
COLOUR_SCALE = (22.0, 5.0, 5.0)  # Lab: hand and face are lit differently, more so than they are coloured differently


@dataclass(frozen=True)
class Close:
    """One hand of a person, as large as in a close-up."""

    image: Image  # (200, 200, 3) window around it
    mask: Mask  # (200, 200)
    frame: HandFrame
    window: Floats  # (4,) x, y, width, height in pixels of the photo


@dataclass(frozen=True)
class Place:
    """Where a hand may be."""

    palm: Floats  # (2,) x, y, pixels of the photo
    hand: float  # expected length of the hand, wrist to fingertips, pixels of the photo


def find_person(bgr: Image) -> Body | None:
    """Return the head of the person in view, in pixels of the photo; None when only a hand or nobody is."""
    grey = cv2.cvtColor(bgr, cv2.COLOR_BGR2GRAY)
    scale = min(1.0, SEARCH_ROWS / grey.shape[0])
    small = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=cv2.INTER_AREA) if scale < 1 else grey
    low, high = (share * small.shape[0] for share in HEAD_SHARE)
    maps = [(head, scores) for head, scores in score_maps(small, *template()) if low <= head <= high]
    found = best_bodies(maps, (small.shape[1], small.shape[0]), 1)
    if not found or found[0].score < SURE:
        return None
    head = found[0]
    return Body(head.x / scale, head.y / scale, head.head / scale, head.score)


def places(bgr: Image, person: Body) -> list[Place]:
    """Return where raised hands may be, off the head and within reach: most like skin before other things first."""
    hand = HAND * person.head
    allowed = _within_reach(bgr.shape[:2], person)
    found: list[tuple[float, Floats]] = []
    for likeness in _likenesses(bgr, person):
        found += _palms(likeness, allowed, hand)
    kept: list[Place] = []
    for _, palm in sorted(found, key=lambda peak: -peak[0]):
        if len(kept) < MOST and all(np.hypot(*(palm - other.palm)) > SAME * hand for other in kept):
            kept.append(Place(palm, hand))
    return kept


def look_closer(bgr: Image, place: Place) -> Iterator[Close]:
    """Yield the hand at a place, once for each way it may point, if what is there has the size of one."""
    side = WINDOW * place.hand
    corner = place.palm - [side / 2, side / 2 + 0.25 * place.hand]
    scale = WINDOW_SIDE / side
    to_window = np.column_stack([np.eye(2) * scale, -corner * scale - 0.5])
    image = cv2.warpAffine(
        bgr, to_window, (WINDOW_SIDE, WINDOW_SIDE), flags=cv2.INTER_CUBIC, borderMode=cv2.BORDER_REPLICATE
    )
    palm = to_window[:, :2] @ place.palm + to_window[:, 2]
    hand = place.hand * scale
    mask = divide(image, palm, CORE * hand)
    if mask is None or not FILLED[0] < mask.mean() < FILLED[1]:
        return
    for frame in hand_frames(mask):
        strayed = float(np.hypot(*(frame.centre - palm))) / hand
        if abs(frame.up_rad) < UPRIGHT and PALM_RADIUS[0] < frame.radius / hand < PALM_RADIUS[1] and strayed < STRAYED:
            yield Close(image, mask, frame, np.array([*corner, side, side]))


def _likenesses(bgr: Image, person: Body) -> Iterator[Floats]:
    """Yield how much each pixel is coloured like the face, 0 to 1, strictly and generously; then the box of eq. 1."""
    lab = _lab(cv2.GaussianBlur(bgr, (0, 0), 0.8))
    rows, columns = np.indices(bgr.shape[:2])
    face = ((columns - person.x) / 0.22) ** 2 + ((rows - person.y) / 0.3) ** 2 < person.head**2
    if face.any():
        distance = np.sqrt((((lab - np.median(lab[face], axis=0)) / COLOUR_SCALE) ** 2).sum(axis=2))
        for limit in LIKE_FACE:
            yield np.exp(-((distance / limit) ** 2))
    yield skin_mask(gray_world(bgr)).astype(float)


def _palms(likeness: Floats, allowed: Mask, hand: float) -> list[tuple[float, Floats]]:
    """Return peaks, with their height, of skin in a palm's disc over skin in the ring around it."""
    palm = cv2.GaussianBlur(likeness, (0, 0), PALM * hand)
    around = cv2.GaussianBlur(likeness, (0, 0), 3 * PALM * hand)
    contrast = np.where(allowed, palm - around, 0.0)
    size = 2 * round(SAME * hand / 2) + 1
    peaks = (contrast >= cv2.dilate(contrast, np.ones((size, size), np.uint8))) & (contrast > LEAST_CONTRAST)
    return [(float(contrast[y, x]), np.array([x, y], float)) for y, x in np.argwhere(peaks)]


def _within_reach(shape: tuple[int, ...], person: Body) -> Mask:
    rows, columns = np.indices(shape)
    x, y = (columns - person.x) / person.head, (rows - person.y) / person.head
    aside, above, below = REACH
    off_head = (x / OFF_HEAD[0]) ** 2 + (y / OFF_HEAD[1]) ** 2 > 1
    return off_head & (np.abs(x) < aside) & (y > -above) & (y < below)


def _lab(bgr: Image) -> np.ndarray:
    return cv2.cvtColor(bgr.astype(np.float32) / 255, cv2.COLOR_BGR2LAB)
