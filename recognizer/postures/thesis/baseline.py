"""The thesis's own chain for a photo of a hand, step by step (S1-S6; chapter 1), kept as a reproducible baseline."""

from __future__ import annotations

from dataclasses import dataclass

from recognizer.postures.errors import NoHandError, NoSkinError
from recognizer.postures.thesis import shape_features
from recognizer.postures.thesis.contour import smooth, sobel_edge, to_thesis_size, trace
from recognizer.postures.thesis.hand_region import Cut, cut_arm, most_featured, recentred
from recognizer.postures.thesis.noise import clean
from recognizer.postures.thesis.skin import gray_world, skin_mask
from recognizer.postures.types import Contour, Floats, Image, Mask

METHOD = "thesis_static"
VERSION = 1
NAMES = shape_features.NAMES
EROSION = 1  # pixels of 144 rows: objects that touch by less are taken apart


@dataclass(frozen=True)
class Stages:
    """What each step of the thesis's chain made of a photo."""

    resized: Image  # (144, w, 3)
    balanced: Image  # after Gray-World
    skin: Mask
    cleaned: Mask  # without noise of both types
    cut: Cut
    hand: Mask  # recentred
    edge: Mask  # Sobel outline of `hand`
    outline: Contour  # smoothed


def stages(bgr: Image) -> Stages:
    """Run the chain.

    Args:
        bgr: (h, w, 3) uint8.

    Raises:
        NoSkinError: no skin object is left after noise removal.
        NoHandError: the hand's outline has no extent.
    """
    resized = to_thesis_size(bgr)
    balanced = gray_world(resized)
    skin = skin_mask(balanced)
    cleaned = clean(skin)
    piece = most_featured(cleaned, EROSION)
    if not piece.any():
        raise NoSkinError("no skin-coloured object in the photo; use more light, or a background unlike skin")
    cut = cut_arm(piece)
    hand = recentred(cut.hand)
    outline = smooth(trace(hand))
    if len(outline) < 20:
        raise NoHandError("what is skin-coloured in the photo is too small for a hand; come closer")
    return Stages(resized, balanced, skin, cleaned, cut, hand, sobel_edge(hand), outline)


def vector(bgr: Image) -> Floats:
    """Return the seven numbers of eq. 6 of the hand in a photo."""
    return shape_features.thesis_vector(stages(bgr).outline)
