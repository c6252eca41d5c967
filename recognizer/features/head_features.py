"""Nodding, shaking, swaying: features of the head's motion at the camera's own rate."""

from __future__ import annotations

import functools
import itertools
import math
from collections.abc import Iterator

import numpy as np

from recognizer.person.head_motion import NAMES

SWAY_SECONDS = 0.7  # slower motion of the head is sway, a nod or shake is quicker
SMOOTH_SECONDS = 0.08  # what a quick camera sees beyond is noise
STRONGEST_SECONDS = 1.0  # a nod or two
FASTEST = 8.0  # head heights per second; beyond it the fit has lost the head
FREQUENCIES = (0.3, 0.9, 1.6, 2.5, 4.5)  # Hz, borders of four bands
_FLOOR = 0.03  # head heights per second that noise amounts to
_FFT = 256
_LIGHT_SIDEWAYS = np.array([0, 1, 0, 1, 0, 0], bool)  # moments that turn round when the clip is mirrored
_LIGHT_FLOOR = 0.004  # of the window's contrast


def head_features(motion: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Describe the head's motion over a clip.

    Args:
        motion: (n, 17) rows of :class:`recognizer.person.head_motion.HeadMotion`; 2 rows at least.

    Yields:
        Groups of features, none of which changes when the clip is mirrored.
    """
    period = float(np.median(motion[:, 1]))
    motions, light, contrast = np.split(motion[:, 2:], [len(NAMES), -1], axis=1)
    right, down, roll, nearer, turn, nod, chest_right, chest_down = motions.T
    # A head that turns about its neck moves, too; a person who sways takes the chest along.
    own_right, own_down = right - chest_right, down - chest_down
    sideways = [right, roll, turn, chest_right, own_right, turn + own_right]
    upright = [down, nearer, nod, chest_down, own_down, nod + own_down]
    quick = _quick(np.column_stack(sideways + upright).clip(-FASTEST, FASTEST), period)
    power = running_mean(quick * quick, round(STRONGEST_SECONDS / period)).sum(axis=1)
    strongest, half = int(np.argmax(power)), max(2, round(STRONGEST_SECONDS / 2 / period))
    turned = np.arange(quick.shape[1]) < len(sideways)
    yield "head_whole", _modes(quick, turned, _FLOOR)
    yield "head_peak", _modes(quick[max(0, strongest - half) : strongest + half + 1], turned, _FLOOR)
    shades = _quick(light / (float(np.median(contrast)) + 1.0), period)
    yield "head_light", _modes(shades, _LIGHT_SIDEWAYS, _LIGHT_FLOOR)
    yield "head_bursts", np.array([0.5 * math.log((power.max() + 1e-3) / (power.mean() + 1e-3))])
    yield "head_beats", np.concatenate([_beats(quick[:, i], period) for i in (len(sideways) - 1, -1)])


def _quick(signals: np.ndarray, period: float) -> np.ndarray:
    """Signals (n, k) without what is slower than a nod or quicker than a camera sees well."""
    smooth = running_mean(signals, round(SMOOTH_SECONDS / period))
    return smooth - running_mean(smooth, round(SWAY_SECONDS / period))


def _modes(signals: np.ndarray, sideways: np.ndarray, floor: float) -> np.ndarray:
    """Sizes (logarithms) and correlations of signals (n, k), of which those ``sideways`` (k,) turn when mirrored.

    What goes along with what tells a nod from a shake of a head that is small or seen from the side, where no single
    motion of the fit does. Correlations across the two kinds come without sign, so that mirroring changes nothing.
    """
    centred = signals - signals.mean(axis=0)
    size = np.sqrt((centred * centred).mean(axis=0)) + floor
    together = centred.T @ centred / len(centred) / np.outer(size, size)
    together = np.where(sideways[:, None] == sideways[None], together, np.abs(together))
    return np.concatenate([np.log(size), together[_pairs(len(size))]])


@functools.cache
def _pairs(count: int) -> tuple[np.ndarray, np.ndarray]:
    """Rows and columns of a square matrix above its diagonal."""
    return np.triu_indices(count, 1)


def running_mean(values: np.ndarray, steps: int) -> np.ndarray:
    """Mean over a window of about ``steps`` values around each, (n, k)."""
    n, half = len(values), max(1, min(steps, len(values))) // 2
    sums = np.concatenate([np.zeros_like(values[:1]), np.cumsum(values, axis=0)])
    last, first = np.minimum(np.arange(n) + half + 1, n), np.maximum(np.arange(n) - half, 0)
    mean: np.ndarray = (sums[last] - sums[first]) / (last - first)[:, None]
    return mean


def _beats(signal: np.ndarray, period: float) -> np.ndarray:
    """Number of turns (its root), and shares of four frequency bands."""
    large = signal[np.abs(signal) > 0.35 * np.abs(signal).max() + 1e-6]
    turns = int((np.diff(np.sign(large)) != 0).sum()) if len(large) > 1 else 0
    length = max(_FFT, 1 << (len(signal) - 1).bit_length())
    spectrum = np.abs(np.fft.rfft(signal * np.hanning(len(signal) + 2)[1:-1], length)) ** 2
    frequency = np.fft.rfftfreq(length, period)
    total = float(spectrum[frequency > FREQUENCIES[0]].sum()) + 1e-3
    bands = itertools.pairwise(FREQUENCIES)
    shares = [float(spectrum[(frequency >= low) & (frequency < high)].sum()) / total for low, high in bands]
    return np.array([math.sqrt(turns), *shares])
