"""A whole person in view: whether there is one, where its hands are, and each hand divided from what is around it.

The head and the raised hand are found together (`hand_finder`), so that neither a sleeve nor a skin-coloured wall
elsewhere in the room matters. At each spot a window as large as a hand is cut out, and the hand in it is divided from
arm, face and room by local contrast: that is what databases with postures of their own are asked with
(`posture_shares` names the others without a mask), and pictures of the stages show it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.person.head_shoulders import Body
from recognizer.postures.hand.hand_frame import HandFrame, hand_frames
from recognizer.postures.person.contrast import divide
from recognizer.postures.person.hand_finder import HAND, Spot, find_hands, find_heads
from recognizer.postures.types import Floats, Image, Mask

SURE = 0.25  # score of a head from which a person is believed to be in view
POSSIBLE = -0.25  # score from which a person may be in view; three of four close-ups of hands stay below
LONGEST_PART = 3.0  # heads: no face and no arm with its hand is longer
CERTAIN = 1.4  # score from which it is no part of a close-up that happens to look like a head
SEVERAL = 1.4  # score from which a further head is another person; 2 to 5 of 100 photos of one person have such
SMALLEST = 22  # pixels of a hand's expected length: below, fingers are some two pixels wide
SHOWN = 4  # spots that are looked at
WINDOW = 1.6  # hand lengths: side of what is cut out around a hand
WINDOW_SIDE = 200  # pixels it is enlarged to
PALM_BELOW = 0.2  # hand lengths from the knuckle that a spot marks to the palm's middle
CORE = 0.09  # hand lengths around the palm's middle that are hand for sure
# What a hand is like at the size that the head tells: palm radius in hand lengths, share of the window that it fills
# (with some forearm), and how far the palm may be from where it was looked for, in hand lengths.
PALM_RADIUS = (0.12, 0.3)
FILLED = (0.06, 0.25)
STRAYED = 0.25
UPRIGHT = np.radians(70)


@dataclass(frozen=True)
class Person:
    """A person in view.

    Attributes:
        head: the likeliest head.
        spots: where its raised hands may be, best first; none when the hand is too small.
        persons: how many heads are in view, this one included.
    """

    head: Body
    spots: tuple[Spot, ...]
    persons: int = 1

    @property
    def score(self) -> float:
        """How sure; see `SURE` and `CERTAIN`."""
        return self.head.score

    @property
    def hand(self) -> float:
        """Expected length of its hands, pixels."""
        return HAND * self.head.head


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


def find_person(bgr: Image) -> Person | None:
    """Return the person in view, in pixels of the photo; None when only a hand or nobody is."""
    heads: list[Body] = find_heads(bgr)
    if not heads or heads[0].score < SURE:
        return None
    spots = tuple(find_hands(bgr, heads)) if HAND * heads[0].head >= SMALLEST else ()
    return Person(heads[0], spots, max(1, sum(head.score >= SEVERAL for head in heads)))


def part_of_person(bgr: Image, length: float) -> bool:
    """Whether an object of ``length`` [px] is rather the face or an arm of whoever looks a little like a person."""
    heads = find_heads(bgr, 1)
    return bool(heads) and heads[0].score >= POSSIBLE and length < LONGEST_PART * heads[0].head


def places(person: Person) -> list[Place]:
    """Return where the palms of a person's raised hands may be, likeliest first."""
    return [Place(np.array([spot.x, spot.y + PALM_BELOW * spot.hand]), spot.hand) for spot in person.spots[:SHOWN]]


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
