"""What does not keep still while a gesture is at its height: a hand that waves, as against one held up.

A hand that moves by more than its own width between two samples has no flow to speak of; that the picture changes
there, and how often, is seen all the same.
"""

from __future__ import annotations

import itertools
from collections.abc import Iterator

import numpy as np

from recognizer.features.phases import Active
from recognizer.person.view import GRID_X, GRID_Y, cell_means

HEIGHT = (0.2, 0.8)  # shares of the active part: without raising and lowering the arm
FREQUENCIES = (0.3, 0.9, 1.6, 2.5, 5.01)  # Hz, borders of four bands
LEVELS = 25.0  # even-contrast levels that bring a map to about 1
_FFT = 64
_SIDES = {
    "right": ((GRID_X < -0.5) & (GRID_Y < 2.5))[::2, ::2].ravel().astype(np.float32),
    "left": ((GRID_X > 0.5) & (GRID_Y < 2.5))[::2, ::2].ravel().astype(np.float32),
}


def unrest_features(active: Active) -> Iterator[tuple[str, np.ndarray]]:
    """Describe how the picture changes in the middle of the active part: where, how much, how often on each side."""
    n = active.last - active.first
    first = active.first + int(HEIGHT[0] * n)
    part = active.pictures[first : max(first + 2, active.first + int(np.ceil(HEIGHT[1] * n)))]
    restless = part - part.mean(axis=0)
    yield "unrest", cell_means(np.abs(restless).mean(axis=0), 2) / LEVELS
    # A quarter of the pixels tells as much about how often.
    sparse = restless[:, ::2, ::2].reshape(len(part), -1)
    frequency = np.fft.rfftfreq(_FFT, active.period)
    turns = 2 * np.pi * active.period * np.outer(frequency, np.arange(len(part)))
    taper = np.hanning(len(part) + 2)[1:-1]
    cosine, sine = ((wave(turns) * taper).astype(np.float32) @ sparse for wave in (np.cos, np.sin))
    power = cosine * cosine + sine * sine
    bands = [(frequency >= low) & (frequency < high) for low, high in itertools.pairwise(FREQUENCIES)]
    for side, inside in _SIDES.items():
        on_side = power @ inside
        shares = np.array([on_side[band].sum() for band in bands])
        total = float(shares.sum()) / len(part) + 1e-3
        yield f"flicker_{side}", np.append(shares / (shares.sum() + 1e-3), np.log(total) / 10)
