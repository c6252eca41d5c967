"""What small convolutional networks are made of when they are asked: rows of inputs times weights, rectified.

They are trained with PyTorch (``tools/train_motion_net.py``, ``tools/train_hand_net.py``); batch normalisation (Ioffe
and Szegedy, 2015) is folded into the weights, and all is float32 and plain NumPy here.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.lib.stride_tricks import as_strided


class Layer(NamedTuple):
    """Weights (d, n) and offsets (n,) of a layer whose inputs are brought to rows of d, as they are stored."""

    weights: np.ndarray
    offsets: np.ndarray

    def __call__(self, inputs: np.ndarray) -> np.ndarray:
        """Rectified output (…, n) of inputs (…, d)."""
        out = (inputs.reshape(-1, inputs.shape[-1]) @ self.weights).reshape(*inputs.shape[:-1], -1)
        out += self.offsets
        return np.maximum(out, 0, out=out)


def patches(maps: np.ndarray, weights: np.ndarray, stride: int) -> np.ndarray:
    """What a convolution with weights (d, n) reads of maps (m, h, w, c), (m, h/stride, w/stride, d); 0 outside."""
    count, height, width, channels = maps.shape
    side = round((len(weights) / channels) ** 0.5)
    around = side // 2
    padded = np.zeros((count, height + 2 * around, width + 2 * around, channels), np.float32)
    padded[:, around:-around, around:-around] = maps
    following, down, right, _ = padded.strides
    rows, columns = height // stride, width // stride
    # A row of a patch lies together in memory.
    shape = (count, rows, columns, side, side * channels)
    view = as_strided(padded, shape, (following, stride * down, stride * right, down, padded.itemsize))
    return view.reshape(count, rows, columns, -1)
