"""How the head moves between two frames: six motions of an ellipsoid, fitted to the whole face at once.

A nod and a shake hardly differ in where something moves; they differ in how the head turns. A turning ellipsoid moves
its middle and leaves its rim (Basu, Essa and Pentland, ICPR 1996); swaying moves both. Fitting few motions to many
pixels is steadier than any flow field, at any size of the head.
"""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from recognizer.person.head_follower import displacement
from recognizer.person.head_shoulders import Body
from recognizer.person.view import View, cut_window, even_contrast

NAMES = ("right", "down", "roll", "nearer", "turn", "nod", "chest_right", "chest_down")
"""Columns of the motions [head heights per second; roll in radians, nearer in shares per second]."""
LIGHT = ("light", "light_right", "light_down", "light_askew", "light_wide", "light_tall", "contrast")
"""Columns of where the face is light and where dark [grey levels]: moments of the picture, and its deviation."""

FACE = View(24, -0.75, 0.75, -0.75, 0.75)
CHEST = View(12, -0.9, 0.9, 1.1, 2.9)
FINE_CONTRAST, CHEST_CONTRAST = 0.12, 1 / 3  # of the windows, evened out over so many head heights
AXES = (0.40, 0.52)  # half width and half height of the head [head heights]
STEPS = 2  # of the fit on each level
# Translation is free; what can only be told from it by the rim or by the eyes' slant needs more evidence.
_STIFFNESS = np.array([0.008, 0.008, 0.020, 0.048, 0.012, 0.012])


class MotionFit:
    """Gauss-Newton fit of a few motion fields between two windows (Lucas and Kanade's, for all pixels together).

    Args:
        fields: (k, 2, h, w) displacement right and down of each pixel for one unit of each motion [px].
        weight: (h, w) how much each pixel counts.
        stiffness: (k,) pull of each motion towards its start, as a share of the evidence for translation.
    """

    def __init__(self, fields: np.ndarray, weight: np.ndarray, stiffness: np.ndarray) -> None:
        self.fields = np.ascontiguousarray(fields, np.float32)
        self.weight = weight.astype(np.float32).ravel()
        self.stiffness = stiffness
        self._flat = self.fields.reshape(len(fields), -1)
        height, width = weight.shape
        columns, rows = np.meshgrid(np.arange(width, dtype=np.float32), np.arange(height, dtype=np.float32))
        self._places = np.stack([columns, rows])

    def __call__(self, first: np.ndarray, second: np.ndarray, start: np.ndarray) -> np.ndarray:
        """Return the amounts (k,) of each motion that take ``first`` to ``second``, (h, w) float32 both.

        The search begins at ``start``, (k,) amounts.
        """
        gx, gy = (cv2.Sobel(first, cv2.CV_32F, *way, ksize=3, scale=1 / 8) for way in ((1, 0), (0, 1)))
        change = (self.fields[:, 0] * gx + self.fields[:, 1] * gy).reshape(len(self.fields), -1)
        weighted = change * self.weight
        normal = (weighted @ change.T).astype(float)
        normal.flat[:: len(normal) + 1] += self.stiffness * (normal[0, 0] + normal[1, 1]) / 2 + 1e-3
        # Small and well conditioned thanks to the stiffness: one inverse serves all steps.
        solver = cv2.invert(normal, flags=cv2.DECOMP_CHOLESKY)[1].astype(np.float32) @ weighted
        amounts, still = start.astype(np.float32), first.ravel()
        for _ in range(STEPS):
            columns, rows = self._places + (amounts @ self._flat).reshape(self._places.shape)
            moved = cv2.remap(second, columns, rows, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
            amounts = amounts - solver @ (moved.ravel() - still)
        return amounts


def _head_fields(pixels: int) -> tuple[np.ndarray, np.ndarray]:
    """Fields and weights of the head's six motions in the window FACE at ``pixels`` a head height."""
    x, y = View(pixels, FACE.left, FACE.right, FACE.top, FACE.bottom).grid()
    beyond = (x / AXES[0]) ** 2 + (y / AXES[1]) ** 2
    bulge, one, none = np.sqrt(np.clip(1 - beyond, 0, 1)), np.ones_like(x), np.zeros_like(x)
    fields = [(one, none), (none, one), (-y, x), (x, y), (bulge, none), (none, bulge)]
    return np.array(fields) * pixels, np.clip(1.6 - beyond, 0, 1)


def _chest_fields(pixels: int) -> tuple[np.ndarray, np.ndarray]:
    """Fields and weights of the chest's two motions in the window CHEST at ``pixels`` a head height."""
    x, y = View(pixels, CHEST.left, CHEST.right, CHEST.top, CHEST.bottom).grid()
    one, none = np.ones_like(x), np.zeros_like(x)
    return np.array([(one, none), (none, one)]) * pixels, np.exp(-(x * x + (y - 2) ** 2) / 0.36)


def _moments() -> np.ndarray:
    """Weights (6, h·w) of a face's mean and its moments about the head's centre, in units of the head's spread."""
    x, y = (c / spread for c, spread in zip(FACE.grid(), (0.3, 0.4), strict=True))
    weight = np.exp(-(x * x + y * y) / 2)
    weight /= weight.sum()
    one = np.ones_like(x)
    return np.array([weight * m for m in (one, x, y, x * y, x * x - 1, y * y - 1)]).reshape(6, -1)


_MOMENTS = _moments()
_HEAD = [MotionFit(*_head_fields(pixels), _STIFFNESS) for pixels in (FACE.pixels // 2, FACE.pixels)]
_TRUNK = [MotionFit(*_chest_fields(CHEST.pixels), np.full(2, 0.02))]  # one level: a chest moves little


class HeadMotion:
    """Measures a head's motion frame by frame, at the camera's own rate, and the chest's from sample to sample."""

    def __init__(self) -> None:
        self._head: tuple[float, Body, list[np.ndarray]] | None = None
        self._chest: tuple[float, Body, list[np.ndarray]] | None = None

    def push(self, looks: Sequence[tuple[float, np.ndarray]], body: Body) -> list[np.ndarray]:
        """Take the next sample's frames, time and (h, w) uint8 grey picture each, with the head about at ``body``.

        Returns:
            for each frame but the very first: time, seconds since the frame before, NAMES and LIGHT, (17,) float32.
            Where the window is does not count: the motions are those in the picture. A chest is slow, and has one
            velocity for all frames of a sample.
        """
        torso = self._torso(*looks[-1], body)
        rows = (self._row(time, grey, body, torso) for time, grey in looks)
        return [row for row in rows if row is not None]

    def _row(self, time: float, grey: np.ndarray, body: Body, torso: np.ndarray) -> np.ndarray | None:
        window = cut_window(grey, body, FACE)
        face = _halves(even_contrast(window, FINE_CONTRAST * FACE.pixels))
        before, self._head = self._head, (time, body, face)
        if before is None:
            return None
        seconds = time - before[0]
        head = _coarse_to_fine(_HEAD, before[2], face)
        head[:2] += displacement(before[1], body)
        contrast = cv2.meanStdDev(window)[1][0]
        row = np.concatenate([(time, seconds), head / seconds, torso, _MOMENTS @ window.ravel(), contrast])
        return row.astype(np.float32)

    def _torso(self, time: float, grey: np.ndarray, body: Body) -> np.ndarray:
        """Velocity of the chest since the sample before, (2,) right and down [head heights per second]."""
        chest = [even_contrast(cut_window(grey, body, CHEST), CHEST_CONTRAST * CHEST.pixels)]
        before, self._chest = self._chest, (time, body, chest)
        if before is None:
            return np.zeros(2)
        moved: np.ndarray = _coarse_to_fine(_TRUNK, before[2], chest) + displacement(before[1], body)
        return moved / (time - before[0])


def _halves(window: np.ndarray) -> list[np.ndarray]:
    height, width = window.shape
    return [cv2.resize(window, (width // 2, height // 2), interpolation=cv2.INTER_AREA), window]


def _coarse_to_fine(fits: list[MotionFit], first: list[np.ndarray], second: list[np.ndarray]) -> np.ndarray:
    amounts = np.zeros(len(fits[0].fields))
    for fit, a, b in zip(fits, first, second, strict=True):
        amounts = fit(a, b, amounts)
    return amounts
