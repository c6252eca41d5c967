"""Our description of a hand posture, from its outline and coverage in its own frame (see `hand_frame`).

Four parts, all classical and each drawable: orientations of the silhouette's edges in 8x8 cells (a histogram of
oriented gradients), the silhouette itself at 16x16, Fourier magnitudes of its outline, and low Fourier coefficients
of the outline with their phase, counted from the middle of the wrist.
"""

from __future__ import annotations

import cv2
import numpy as np

from recognizer.postures.hand.hand_frame import SIDE, VIEW, VIEW_BELOW, HandFrame, canonical_mask
from recognizer.postures.thesis.contour import resample, trace
from recognizer.postures.types import Contour, Floats, Mask

METHOD = "static"
VERSION = 1
CELLS = 8
ORIENTATIONS = 8
COARSE = 16
MAGNITUDES = 20  # harmonics each way
HARMONICS = 16
POINTS = 128  # along the outline
# Scale of the parts against each other, so that each spreads about as much as the others.
MAGNITUDE_WEIGHT = 3.0
NAMES = (
    *(f"edge_{o}_{y}_{x}" for o in range(ORIENTATIONS) for y in range(CELLS) for x in range(CELLS)),
    *(f"cover_{y}_{x}" for y in range(COARSE) for x in range(COARSE)),
    *(f"magnitude_{n}" for n in (*range(1, MAGNITUDES + 1), *range(-MAGNITUDES, 0))),
    *(f"{part}_{n}" for part in ("re", "im") for n in (*range(1, HARMONICS + 1), *range(-HARMONICS, 0))),
)


def describe(mask: Mask, frame: HandFrame) -> Floats:
    """Return the posture vector of one hand, (872,), named by `NAMES`.

    Args:
        mask: (h, w) bool, the hand with or without its arm.
        frame: where its palm is; see `recognizer.postures.hand.hand_frame.hand_frames`.
    """
    view = canonical_mask(mask, frame)
    outline = trace(view > 0.5)
    cover = cv2.resize(cv2.GaussianBlur(view, (0, 0), 1.5), (COARSE, COARSE), interpolation=cv2.INTER_AREA)
    return np.concatenate(
        [edge_orientations(view), cover.ravel(), MAGNITUDE_WEIGHT * magnitudes(outline), harmonics(outline)]
    )


def edge_orientations(view: Floats) -> Floats:
    """Return the strength of edges by orientation and cell, (512,), each cell normalised by its neighbourhood."""
    gy, gx = np.gradient(view)
    strength = np.hypot(gx, gy)
    turn = (np.arctan2(gy, gx) % np.pi) / np.pi * ORIENTATIONS
    lower = np.floor(turn).astype(int)
    share = turn - lower
    planes = np.zeros((ORIENTATIONS, *view.shape))
    rows, columns = np.indices(view.shape)
    planes[lower % ORIENTATIONS, rows, columns] += strength * (1 - share)
    planes[(lower + 1) % ORIENTATIONS, rows, columns] += strength * share
    cell = SIDE // CELLS
    cells = np.array([cv2.GaussianBlur(plane, (0, 0), cell / 2.5) for plane in planes])
    cells = cells.reshape(ORIENTATIONS, CELLS, cell, CELLS, cell).mean(axis=(2, 4)) * cell**2 / 4
    energy = cv2.GaussianBlur((cells**2).sum(axis=0), (0, 0), 1)
    return (cells / np.sqrt(energy + 1.0)).ravel()


def magnitudes(outline: Contour) -> Floats:
    """Return Fourier magnitudes of the outline over the largest, (40,): free of place, size, turn and start."""
    if len(outline) < 8:
        return np.zeros(2 * MAGNITUDES)
    x, y = resample(outline, POINTS).T
    spectrum = np.abs(np.fft.fft(x - x.mean() + 1j * (y - y.mean()))) / POINTS
    chosen = np.concatenate([spectrum[1 : MAGNITUDES + 1], spectrum[-MAGNITUDES:]])
    return chosen / max(float(chosen.max()), 1e-9)


def harmonics(outline: Contour) -> Floats:
    """Return low complex Fourier coefficients of the outline around the palm, (64,), starting at the wrist."""
    if len(outline) < 8:
        return np.zeros(4 * HARMONICS)
    points = resample(outline, POINTS)
    palm = np.array([SIDE / 2, SIDE * (1 - VIEW_BELOW / VIEW)])
    wrist = np.array([SIDE / 2, SIDE - 1.0])
    start = int(np.argmin(np.hypot(*(points - wrist).T)))
    x, y = np.roll(points - palm, -start, axis=0).T
    spectrum = np.fft.fft(x + 1j * y) / POINTS
    chosen = np.concatenate([spectrum[1 : HARMONICS + 1], spectrum[-HARMONICS:]])
    return np.concatenate([chosen.real, chosen.imag]) / 8
