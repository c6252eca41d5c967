"""Windows of hands that are drawn rather than filmed: `recognizer.postures.model_hand` with flesh, shades and creases.

They have other proportions than the figure's hands and anything behind them, from nearly flat to deeply shaded, so that
the network of ``tools/train_hand_net.py`` does not learn how one renderer draws a folded finger.
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.learning.database import IRRELEVANT
from recognizer.postures.model_hand.silhouettes import flesh, seen_hull, view_of
from recognizer.postures.model_hand.skeleton import Build, Posture, pose, postures

FINE = 3  # drawn so many times larger, then averaged
PALM_WIDTHS = 2.37  # from the wrist to the fingertips of the average build
# Lab of skin, from pale to dark; each hand is between two neighbours and departs from them by chance.
SKINS = np.array([[86, 6, 14], [74, 12, 20], [62, 15, 24], [48, 15, 22], [34, 11, 15], [24, 7, 9]], float)


def drawn_hands(
    count: int, hand: int, side: int, behind: np.ndarray, rng: np.random.Generator
) -> tuple[np.ndarray, np.ndarray]:
    """Return windows (count, side, side, 3) uint8 BGR and their labels, all postures of the model hand in turn.

    Args:
        count: how many.
        hand: pixels of a hand's length; the middle finger's knuckle stands in the window's middle.
        side: pixels of a window.
        behind: (n, side, side, 3) pictures of which one is behind each hand.
        rng: of everything.
    """
    known = [p for p in postures() for _ in range(1 if p.label == IRRELEVANT else 2)]
    chosen = [known[k % len(known)] for k in range(count)]
    windows = [_drawn(posture, hand, side, behind[int(rng.integers(len(behind)))], rng) for posture in chosen]
    labels = [f"{p.label} {p.action}".strip() for p in chosen]
    return np.array(windows), np.array(labels)


def _drawn(posture: Posture, hand: int, side: int, behind: np.ndarray, rng: np.random.Generator) -> np.ndarray:
    build = Build.draw(rng)
    skeleton = pose(posture, build, rng)
    view = view_of(posture, rng)
    scale = FINE * hand / PALM_WIDTHS
    middle = FINE * side / 2 - (view @ skeleton.fingers["middle"][0])[:2] * [scale, -scale]
    bare = float(rng.choice([8.0, rng.uniform(0.0, 0.8)]))
    pieces = flesh(skeleton, build, 8.0)
    nearness = [float(np.mean([(view @ centre)[2] for centre, _ in piece])) for piece in pieces]
    skin, sleeve = _skin(rng), rng.uniform(10, 245, 3)
    depth, crease = rng.uniform(0, 0.5), rng.uniform(0, 0.35) * (rng.random() < 0.7)
    room = cv2.resize(behind, (FINE * side,) * 2, interpolation=cv2.INTER_LINEAR).astype(np.float32)
    paint = room.copy()
    cover = np.zeros(paint.shape[:2], np.uint8)
    for k in np.argsort(nearness):  # from far to near
        hull = seen_hull(pieces[k], view, scale, middle)
        below = np.mean([c[1] for c, _ in pieces[k]]) < -0.5 * bare - 0.2
        colour = sleeve if below else skin * (1 + depth * (nearness[k] - 0.2) + rng.normal(0, 0.02))
        cv2.fillConvexPoly(paint, hull, tuple(map(float, colour)), cv2.LINE_AA, shift=4)
        if crease:
            edge = tuple(map(float, colour * (1 - crease)))
            cv2.polylines(paint, [hull], True, edge, max(1, round(0.02 * scale)), cv2.LINE_AA, shift=4)
        cv2.fillConvexPoly(cover, hull, 255, shift=4)
    soft = cv2.GaussianBlur(paint, (0, 0), FINE * rng.uniform(0.3, 1.0))  # the hand's own softness, not the room's
    inside = (cv2.GaussianBlur(cover, (0, 0), FINE * 0.5).astype(np.float32) / 255)[..., None]
    slope = rng.normal(0, 0.3, 2)
    ramp = np.linspace(-1, 1, FINE * side)
    light = (1 + slope[0] * ramp[:, None] + slope[1] * ramp)[..., None]
    picture = room + inside * (soft * light - room)
    small = cv2.resize(picture.astype(np.float32), (side, side), interpolation=cv2.INTER_AREA)
    if rng.random() < 0.5:
        small = small[:, ::-1]
    return np.clip(small + rng.normal(0, rng.uniform(0, 4), small.shape), 0, 255).astype(np.uint8)


def _skin(rng: np.random.Generator) -> np.ndarray:
    at = rng.uniform(0, len(SKINS) - 1)
    low = int(min(at, len(SKINS) - 2))
    lab = SKINS[low] + (at - low) * (SKINS[low + 1] - SKINS[low]) + rng.normal(0, (6, 3, 4))
    bgr = cv2.cvtColor(lab.astype(np.float32)[None, None], cv2.COLOR_LAB2BGR)[0, 0]
    return np.clip(np.asarray(bgr, float) * 255, 8, 250)
