"""Everything in a photo that may be a hand: objects of several segmentations, each looked at closely.

The skin box of eq. 1 after Gray-World comes first; without Gray-World and the departure from a plain background stand
in where light or skin defeat it. Where a person is in view, hands are looked for off the head (`person`). Which
candidate is the hand is decided later, by its distance to known hands.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.postures.errors import HandTooSmallError, NoHandError, NoSkinError
from recognizer.postures.hand import background
from recognizer.postures.hand.hand_frame import HandFrame, hand_frames
from recognizer.postures.person.person_in_view import CERTAIN, SMALLEST, Person, find_person, look_closer, places
from recognizer.postures.thesis.hand_region import most_featured
from recognizer.postures.thesis.noise import clean
from recognizer.postures.thesis.skin import gray_world, gray_world_gains, skin_mask
from recognizer.postures.types import Floats, Image, Mask

WORK_SIDE = 200  # pixels: longer side at which objects are looked at
MOST_OBJECTS = 4  # of one segmentation
SMALLEST_OBJECT = 0.004  # of the picture's area
CLOSER = 0.6  # of the longer side: smaller objects are cut out of the photo and looked at in detail
PLAIN = 0.7  # share of the border that one smooth colour surface must explain
TOO_MUCH = 0.8  # of the picture's area: then the background was taken for skin


@dataclass(frozen=True)
class Candidate:
    """One object that may be a hand, with one guess of which way it points."""

    segmentation: str  # "skin", "skin without Gray-World", "background" or "person"
    number: int  # of the object within its segmentation; the likeliest hand is 0
    image: Image  # (h, w, 3) what the mask belongs to: the photo or a cut-out of it, at working size
    mask: Mask  # (h, w)
    frame: HandFrame
    box: Floats  # (4,) x, y, width, height of the object as fractions of the photo
    size: tuple[int, int]  # width and height of the photo

    def fills(self) -> bool:
        """Whether the object is as long as in a close-up."""
        return self.length >= CLOSER * max(self.size)

    @property
    def length(self) -> float:
        """Longer side of the object's box, pixels of the photo."""
        return float(max(self.box[2:] * self.size))


def to_work_size(bgr: Image, side: int = WORK_SIDE) -> Image:
    """Return the picture with its longer side at ``side`` pixels; cubic when it grows, averaged when it shrinks."""
    scale = side / max(bgr.shape[:2])
    how = cv2.INTER_CUBIC if scale > 1 else cv2.INTER_AREA
    size = max(1, round(bgr.shape[1] * scale)), max(1, round(bgr.shape[0] * scale))
    return cv2.resize(bgr, size, interpolation=how)


def candidates(bgr: Image) -> list[Candidate]:
    """Return every candidate of every segmentation, likeliest segmentation first.

    Args:
        bgr: (h, w, 3) uint8 photo of any size.

    Raises:
        NoSkinError: no segmentation finds an object.
        NoHandError: a person is in view, but no raised hand, or too small a one.
    """
    person = find_person(bgr)
    return close_up(bgr) if person is None else of_person(bgr, person)


def of_person(bgr: Image, person: Person) -> list[Candidate]:
    """Return the hands of a person in view, divided from their surroundings; in doubt also objects of a close-up."""
    height, width = bgr.shape[:2]
    size = np.array([width, height, width, height])
    found = beside_person(bgr, person)
    found += [
        Candidate("person", number, close.image, close.mask, close.frame, close.window / size, (width, height))
        for number, place in enumerate(places(person))
        for close in look_closer(bgr, place)
    ]
    if not found:
        check_size(person)
        raise NoHandError("a person is in view, but no raised hand off the face; show the hand beside the head")
    return found


def beside_person(bgr: Image, person: Person) -> list[Candidate]:
    """Return what a close-up would show where the person is in doubt: objects that fill the picture."""
    if person.score >= CERTAIN:
        return []
    try:
        return [c for c in close_up(bgr) if c.fills()]
    except NoSkinError:
        return []


def check_size(person: Person) -> None:
    """Refuse a person too far away.

    Raises:
        HandTooSmallError: the hand is too small to tell its fingers apart.
    """
    if person.hand < SMALLEST:
        raise HandTooSmallError(
            f"the hand is about {person.hand:.0f} pixels long, too small to tell its fingers apart; "
            f"come closer, so that it has {SMALLEST} at least"
        )


def close_up(bgr: Image) -> list[Candidate]:
    """Return every object of every segmentation, wherever it is.

    Raises:
        NoSkinError: there is none.
    """
    work = to_work_size(bgr)
    gains = gray_world_gains(work)
    found = [
        candidate
        for name, mask in segmentations(work, gains)
        for number, piece in enumerate(objects(mask))
        for candidate in _closer(bgr, work, gains, name, number, piece)
    ]
    if not found:
        raise NoSkinError(
            "no skin-coloured object in the photo, and none that stands out from a plain background; "
            "use more light, or a background unlike skin"
        )
    return found


def is_plain(bgr: Image) -> bool:
    """Whether one smooth colour surface explains the picture's border, as where a hand is held before a wall."""
    return background.departure(to_work_size(bgr)).plainness >= PLAIN


def segmentations(bgr: Image, gains: Floats) -> Iterator[tuple[str, Mask]]:
    """Yield the name and the cleaned mask of each segmentation that found something."""
    for name in ("skin", "skin without Gray-World", "background"):
        mask = _segment(name, bgr, gains)
        if mask is not None and 0 < mask.mean() < TOO_MUCH:
            yield name, mask


def _segment(name: str, bgr: Image, gains: Floats) -> Mask | None:
    if name == "skin":
        return clean(skin_mask(gray_world(bgr, gains)))
    if name == "skin without Gray-World":
        return clean(skin_mask(bgr))
    found = background.departure(bgr)
    return clean(background.foreground(found)) if found.plainness >= PLAIN else None


def objects(mask: Mask) -> list[Mask]:
    """Return the objects of a mask, the one with most feature pixels first, then by size; small ones are left out."""
    _, labels, stats, _ = cv2.connectedComponentsWithStats(mask.astype(np.uint8), connectivity=8)
    areas = stats[:, cv2.CC_STAT_AREA]
    order = [int(i) for i in np.argsort(-areas) if i > 0 and areas[i] >= SMALLEST_OBJECT * mask.size][:MOST_OBJECTS]
    if not order:
        return []
    kept = np.isin(labels, order)
    first = int(labels[most_featured(kept)][0])
    order.sort(key=lambda label: label != first)
    return [labels == label for label in order]


def _closer(bgr: Image, work: Image, gains: Floats, name: str, number: int, piece: Mask) -> Iterator[Candidate]:
    """Yield an object's candidates: as seen, or cut out of the photo with a margin when it is small in it."""
    x, y, width, height = cv2.boundingRect(piece.astype(np.uint8))
    rows, columns = piece.shape
    box = np.array([x / columns, y / rows, width / columns, height / rows])
    image, mask = work, piece
    if max(width, height) < CLOSER * max(rows, columns):
        cut = _cut_out(bgr, box)
        image = to_work_size(cut)
        closer = _segment(name, image, gains)
        if closer is None or not closer.any():
            return
        mask = objects(closer)[0] if objects(closer) else closer
    for frame in hand_frames(mask):
        yield Candidate(name, number, image, mask, frame, box, (bgr.shape[1], bgr.shape[0]))


def _cut_out(bgr: Image, box: Floats, margin: float = 0.15) -> Image:
    """Return the part of the photo around a box, with a margin on each side as a share of the box's longer side."""
    height, width = bgr.shape[:2]
    x, y, w, h = box * [width, height, width, height]
    extra = margin * max(w, h)
    left, top = max(0, int(x - extra)), max(0, int(y - extra))
    return bgr[top : int(np.ceil(y + h + extra)), left : int(np.ceil(x + w + extra))]
