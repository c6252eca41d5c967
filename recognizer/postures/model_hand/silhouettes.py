"""Silhouettes of the model hand: flesh on its bones, a camera's view, and the noise of a skin mask."""

from __future__ import annotations

from itertools import pairwise

import cv2
import numpy as np
from scipy.spatial.transform import Rotation

from recognizer.postures.model_hand.skeleton import FINGERS, RADII, THUMB_RADII, Build, Piece, Posture, Skeleton, pose
from recognizer.postures.thesis.hand_region import largest
from recognizer.postures.types import Floats, Mask

SIZE = 200  # pixels, both ways
_CIRCLE = np.column_stack([f(np.linspace(0, 2 * np.pi, 20, endpoint=False)) for f in (np.cos, np.sin)])


def silhouette(posture: Posture, build: Build, rng: np.random.Generator) -> Mask:
    """Return one filmed take of a posture as a skin mask, left or right hand, (200, 200) bool."""
    skeleton = pose(posture, build, rng)
    view = view_of(posture, rng)
    sleeved = rng.uniform() < 0.2
    forearm = rng.uniform(0.1, 0.6) if sleeved else 8.0
    pieces = flesh(skeleton, build, forearm)
    scale, origin = _framing(skeleton.points() @ view.T, forearm if sleeved else None, rng)
    mask = draw(pieces, view, scale, origin, SIZE)
    if rng.uniform() < 0.5:
        mask = mask[:, ::-1]
    edge = rng.uniform()  # skin masks lose or gain a pixel along the outline
    if edge < 0.45:
        change = cv2.erode if edge < 0.3 else cv2.dilate
        mask = change(np.ascontiguousarray(mask).astype(np.uint8), np.ones((3, 3), np.uint8)) > 0
    return largest(np.ascontiguousarray(mask))


def view_of(posture: Posture, rng: np.random.Generator) -> Floats:
    """Return the rotation from hand to camera, (3, 3): a turn about the forearm, a nod, a tilt in the picture."""
    yaw, pitch, roll = rng.normal(posture.yaw[0], posture.yaw[1]), rng.normal(0, 12), rng.normal(0, 10)
    return Rotation.from_euler("ZXY", [roll, pitch, yaw], degrees=True).as_matrix()


def _framing(points: Floats, sleeved_forearm: float | None, rng: np.random.Generator) -> tuple[float, Floats]:
    """Return pixels per palm width and where the wrist stands in the picture."""
    top = points[:, 1].max() + 0.1
    left, right = points[:, 0].min() - 0.15, points[:, 0].max() + 0.15
    arm = rng.uniform(0.0, 1.2)
    fill = rng.uniform(0.72, 0.97) if rng.uniform() < 0.9 else rng.uniform(0.5, 0.75)
    scale = min(SIZE * fill / (top + arm), SIZE * 0.95 / (right - left))
    below = arm if sleeved_forearm is None else sleeved_forearm + rng.uniform(0, 0.3)
    x = SIZE / 2 - (left + right) / 2 * scale + rng.normal(0, 0.06) * SIZE
    return scale, np.array([x, SIZE - below * scale])


def flesh(skeleton: Skeleton, build: Build, forearm: float) -> list[Piece]:
    """Return the convex pieces that make up hand and forearm.

    Args:
        skeleton: joints, palm widths.
        build: the person.
        forearm: length of it that shows skin, palm widths.
    """
    thick, wide = build.thickness, build.palm_width
    fingers, thumb = skeleton.fingers, skeleton.thumb
    pieces: list[Piece] = []
    limbs: list[tuple[Floats, tuple[float, ...]]] = [(fingers[name], RADII[name]) for name in FINGERS]
    for joints, radii in [*limbs, (thumb, THUMB_RADII)]:
        balls = [(joints[i], radii[i] * thick) for i in range(len(joints))]
        pieces.extend([a, b] for a, b in pairwise(balls))
    half = 0.29 * build.wrist - 0.1
    wrist: Piece = [(np.array([-half, 0.0, 0.0]), 0.11), (np.array([half, 0.0, 0.0]), 0.11)]
    roots = [(fingers[name][0], radius) for name, radius in zip(FINGERS, (0.13, 0.13, 0.12, 0.12), strict=True)]
    side = np.array([0.28 * wide, 0.6, 0.0])
    pieces += [
        [*wrist, *roots, (np.array([-0.3 * wide, 0.4, 0.05]), 0.13)],  # the palm
        [wrist[1], (thumb[0], 0.19 * thick), (thumb[1], 0.15 * thick), (side, 0.12)],  # ball of the thumb
        [wrist[1], (thumb[0], 0.2 * thick), (fingers["index"][0], 0.12)],
        [(thumb[0], 0.15), (0.35 * thumb[0] + 0.65 * thumb[1], 0.11), (fingers["index"][0] * 0.75 + side * 0.25, 0.08)],
    ]
    for a, b in pairwise(FINGERS):  # webs between the fingers
        near = [(fingers[f][0], 0.1) for f in (a, b)]
        pieces.append([*near, *((0.58 * fingers[f][0] + 0.42 * fingers[f][1], 0.05) for f in (a, b))])
    return pieces + _forearm(wrist, build, forearm)


def _forearm(wrist: Piece, build: Build, length: float) -> list[Piece]:
    taper = min(length, 2.5)
    half = (0.36 + 0.06 * taper) * build.arm * build.wrist - 0.1
    rings = [wrist, *([(np.array([x, -y, 0.0]), 0.11) for x in (-half, half)] for y in (taper, length))]
    return [[*a, *b] for a, b in pairwise(rings)]


def draw(pieces: list[Piece], view: Floats, scale: float, origin: Floats, size: int) -> Mask:
    """Return the pixels that the pieces cover, seen from afar along z.

    Args:
        pieces: in hand coordinates, palm widths.
        view: (3, 3) rotation from hand to camera.
        scale: pixels per palm width.
        origin: (2,) pixel of the wrist.
        size: pixels of the square picture.
    """
    canvas = np.zeros((size, size), np.uint8)
    for piece in pieces:
        hull = seen_hull(piece, view, scale, origin)
        cv2.fillConvexPoly(canvas, hull, 255, shift=4)  # coordinates in sixteenths of a pixel
    return canvas > 0


def seen_hull(piece: Piece, view: Floats, scale: float, origin: Floats) -> np.ndarray:
    """Return the outline of one piece, (n, 1, 2) int32 in sixteenths of a pixel; arguments as for :func:`draw`."""
    rims = []
    for centre, radius in piece:
        x, y, _ = view @ centre
        rims.append(np.array([x, -y]) * scale + origin + _CIRCLE * (radius * scale))
    return np.asarray(cv2.convexHull(np.round(np.vstack(rims) * 16).astype(np.int32)))
