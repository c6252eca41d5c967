"""Nodding, shaking, swaying: features of the head's motion at the camera's own rate."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterator

import numpy as np

SWAY_SECONDS = 0.7  # slower motion of the head is sway, a nod or shake is quicker
SMOOTH_SECONDS = 0.08  # what a quick camera sees beyond is noise
STRONGEST_SECONDS = 1.0  # a nod or two
FASTEST = 8.0  # head heights per second; beyond it the fit has lost the head
FREQUENCIES = (0.3, 0.9, 1.6, 2.5, 4.5)  # Hz, borders of four bands
_FLOOR = 0.03  # head heights per second that noise amounts to
_FFT = 256
# Pairs of motions: what goes along with what.
_TOGETHER = ((0, 1), (2, 4), (3, 5), (2, 8), (3, 8), (4, 9), (5, 10), (2, 3))


def head_features(motion: np.ndarray) -> Iterator[tuple[str, np.ndarray]]:
    """Describe the head's motion over a clip.

    Args:
        motion: (n, 10) rows of :class:`recognizer.head_motion.HeadMotion`; 2 rows at least.

    Yields:
        Groups of features, none of which changes when the clip is mirrored.
    """
    period = float(np.median(motion[:, 1]))
    right, down, roll, _, turn, nod, chest_right, chest_down = motion[:, 2:].T
    own_right, own_down = right - chest_right, down - chest_down
    signals = np.column_stack(
        [turn + own_right, nod + own_down, turn, nod, right, down, own_right, own_down, roll, chest_right, chest_down]
    ).clip(-FASTEST, FASTEST)
    signals = running_mean(signals, round(SMOOTH_SECONDS / period))
    quick = signals - running_mean(signals, round(SWAY_SECONDS / period))
    power = running_mean(quick * quick, round(STRONGEST_SECONDS / period))
    both = power[:, 0] + power[:, 1]
    strongest = int(np.argmax(both))
    half = max(2, round(STRONGEST_SECONDS / 2 / period))
    peak, whole = np.sqrt(power[strongest]) + _FLOOR, quick.std(axis=0) + _FLOOR
    yield "head_peak", np.log(peak)
    yield "head_whole", np.log(whole)
    yield "head_nod_or_shake", np.log([s[down] / s[down - 1] for s in (peak, whole) for down in (1, 3, 5, 7)])
    yield "head_together", _together(quick[max(0, strongest - half) : strongest + half + 1])
    yield "head_bursts", np.array([0.5 * math.log((both.max() + 1e-3) / (both.mean() + 1e-3))])
    yield "head_beats", np.concatenate([_beats(quick[:, i], period) for i in (0, 1)])


def running_mean(values: np.ndarray, steps: int) -> np.ndarray:
    """Mean over a window of about ``steps`` values around each, (n, k)."""
    window = np.ones(max(1, min(steps, len(values))) | 1)
    n = len(values)
    covered = np.convolve(np.ones(n), window, "same")[:n]
    return np.column_stack([np.convolve(column, window, "same")[:n] for column in values.T]) / covered[:, None]


def _together(quick: np.ndarray) -> np.ndarray:
    """Correlations of pairs of motions, without sign where mirroring would turn it."""
    centred = quick - quick.mean(axis=0)
    size = np.sqrt((centred * centred).mean(axis=0)) + 0.01
    found = np.array([(centred[:, i] * centred[:, j]).mean() / (size[i] * size[j]) for i, j in _TOGETHER])
    return np.append(np.abs(found), found[1:3])


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
