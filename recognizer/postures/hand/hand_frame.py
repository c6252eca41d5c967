"""The hand's own frame: palm circle as origin and unit length, fingers upwards, arm cut off.

Everything our features see is measured in this frame, so that place, size and tilt in the picture do not matter.
The palm circle is the largest disc inside the hand; the arm is the one limb on a ring around it that is as wide
as a wrist.
"""

from __future__ import annotations

from dataclasses import dataclass

import cv2
import numpy as np

from recognizer.postures.thesis.hand_region import centroid
from recognizer.postures.thesis.noise import fill_holes
from recognizer.postures.types import Floats, Mask

RINGS = (1.35, 1.6, 1.9)  # palm radii at which limbs are looked for
WRIST_WIDTH = 1.0  # palm radii: a limb at least this wide is an arm; a finger is about half as wide
BORDER_WIDTH = (
    0.3  # of the object's side (root of its area): a part at least this wide that leaves the picture is an arm
)
DEPTH_COST = 0.15  # pixels of palm radius that one pixel further from the fingertips must gain
SAME_DIRECTION = 0.94  # cosine (20°): directions nearer than this are one
CUT_BELOW = 1.25  # palm radii below the centre where the arm is dropped
VIEW = 6.0  # palm radii: side of the canonical view
VIEW_BELOW = 1.6  # palm radii of it that lie below the palm's centre
SIDE = 64  # pixels of the canonical view


@dataclass(frozen=True)
class HandFrame:
    """Where the hand's frame stands in the picture."""

    centre: Floats  # (2,) x, y of the palm circle, pixels
    radius: float  # of the palm circle, pixels
    up_rad: float  # direction of the fingers: 0 is the picture's up, positive clockwise
    arm_found: bool  # whether `up_rad` was measured, or upright was assumed

    def to_view(self) -> Floats:
        """Return the (2, 3) affine map from picture to canonical-view pixels."""
        scale = SIDE / (VIEW * self.radius)
        c, s = np.cos(-self.up_rad) * scale, np.sin(-self.up_rad) * scale
        turn = np.array([[c, -s], [s, c]])
        middle = np.array([SIDE / 2, SIDE * (1 - VIEW_BELOW / VIEW)]) - 0.5
        return np.column_stack([turn, middle - turn @ self.centre])


def hand_frames(mask: Mask) -> list[HandFrame]:
    """Find the direction of the fingers of one object, then its palm circle.

    Args:
        mask: (h, w) bool, not empty.

    Returns:
        one frame where the arm leaves the picture, which is certain. Otherwise the possible ones, likeliest first:
        upright, and against the widest limb around the largest disc.
    """
    whole = fill_holes(mask, max_fraction=1.0)  # a ring counts as closed, however much of its hole shows
    distance = cv2.distanceTransform(np.pad(whole, 1).astype(np.uint8), cv2.DIST_L2, 5)[1:-1, 1:-1]
    arm = _arm_at_border(whole)
    if arm is not None:
        return [_frame_along(whole, distance, -arm, True)]
    frames = [_frame_along(whole, distance, np.array([0.0, -1.0]), False)]
    best = np.unravel_index(int(np.argmax(distance)), distance.shape)
    arm = _arm_on_rings(whole, np.array([best[1], best[0]], float), float(distance.max()))
    if arm is not None and arm[1] < SAME_DIRECTION:
        frames.append(_frame_along(whole, distance, -arm, True))
    return frames


def _frame_along(whole: Mask, distance: np.ndarray, up: Floats, arm_found: bool) -> HandFrame:
    """Place the palm circle, given the direction of the fingers.

    The palm is wide and near the fingers' end; a forearm can be as wide, but is further from it.
    """
    ys, xs = np.nonzero(whole)
    height = xs * up[0] + ys * up[1]
    inside = distance[ys, xs]
    score = inside - DEPTH_COST * (height.max() - height)
    best = int(np.argmax(score))
    radius = float(inside[best])
    # The middle of all places about as good: steadier than the single best pixel.
    near = (score >= score[best] - 0.04 * radius) & (np.hypot(xs - xs[best], ys - ys[best]) <= 0.5 * radius)
    centre = np.array([xs[near].mean(), ys[near].mean()])
    return HandFrame(centre, radius, float(np.arctan2(up[0], -up[1])), arm_found)


def _arm_at_border(mask: Mask) -> Floats | None:
    """Return the unit vector from the object's middle to where its widest part leaves the picture, if it does."""
    height, width = mask.shape
    around = np.concatenate([mask[0], mask[1:, -1], mask[-1, -2::-1], mask[-2:0:-1, 0]])
    x = np.concatenate(
        [np.arange(width), np.full(height - 1, width - 1), np.arange(width - 2, -1, -1), np.zeros(height - 2)]
    )
    y = np.concatenate(
        [np.zeros(width), np.arange(1, height), np.full(width - 1, height - 1), np.arange(height - 2, 0, -1)]
    )
    run = _longest_run(around)
    if run is None or run[1] < BORDER_WIDTH * np.sqrt(mask.sum()):
        return None
    index = (run[0] + np.arange(run[1])) % len(around)
    offset = np.array([x[index].mean(), y[index].mean()]) - centroid(mask)
    return offset / max(float(np.hypot(*offset)), 1e-9)


def _longest_run(ring: Mask) -> tuple[int, int] | None:
    """Return start and length of the longest run of True on a closed ring; None if there is none, or no end."""
    if ring.all() or not ring.any():
        return None
    first = int(np.argmin(ring))
    edges = np.diff(np.concatenate([[0], np.roll(ring, -first).astype(np.int8), [0]]))
    starts, ends = np.nonzero(edges == 1)[0], np.nonzero(edges == -1)[0]
    widest = int(np.argmax(ends - starts))
    return (first + int(starts[widest])) % len(ring), int(ends[widest] - starts[widest])


def _arm_on_rings(mask: Mask, centre: Floats, radius: float) -> Floats | None:
    """Return the unit vector from the palm to the arm: the mean of the widest limb on each ring, if one is wide."""
    total = np.zeros(2)
    for ring in RINGS:
        limb = _widest_limb(mask, centre, ring * radius)
        if limb is not None and limb[1] >= WRIST_WIDTH * radius:
            total += limb[0]
    norm = float(np.hypot(*total))
    return total / norm if norm > 0.5 else None


def _widest_limb(mask: Mask, centre: Floats, radius: float) -> tuple[Floats, float] | None:
    """Return the direction and the arc length, pixels, of the longest run of skin on a circle."""
    count = 180
    angles = np.arange(count) * 2 * np.pi / count
    x = np.round(centre[0] + radius * np.cos(angles)).astype(int)
    y = np.round(centre[1] + radius * np.sin(angles)).astype(int)
    # Beyond the border the arm goes on: take the nearest pixel inside.
    skin = mask[np.clip(y, 0, mask.shape[0] - 1), np.clip(x, 0, mask.shape[1] - 1)]
    run = _longest_run(skin)
    if run is None:
        return None
    middle = (run[0] + (run[1] - 1) / 2) * 2 * np.pi / count
    chord = 2 * radius * np.sin(min(np.pi / 2, run[1] * np.pi / count))
    return np.array([np.cos(middle), np.sin(middle)]), float(chord)


def canonical_mask(mask: Mask, frame: HandFrame) -> Floats:
    """Return the (64, 64) coverage in [0, 1] of the hand in its own frame, without the arm."""
    view = warp(mask.astype(np.float32), frame)
    view[_cut_row() :] = 0.0
    return view


def warp(image: np.ndarray, frame: HandFrame) -> Floats:
    """Return the (64, 64) view of a single-channel picture in the hand's frame; the border is repeated outwards."""
    shrink = VIEW * frame.radius / SIDE
    if shrink > 1.5:  # averaged first, or thin fingers would be sampled away
        image = cv2.GaussianBlur(image, (0, 0), 0.4 * shrink, borderType=cv2.BORDER_REPLICATE)
    return cv2.warpAffine(
        image, frame.to_view(), (SIDE, SIDE), flags=cv2.INTER_LINEAR, borderMode=cv2.BORDER_CONSTANT, borderValue=0
    ).astype(np.float64)


def _cut_row() -> int:
    return round(SIDE * (1 - (VIEW_BELOW - CUT_BELOW) / VIEW))
