"""What a small convolutional network sees in the person's window: 128 numbers, however long the clip.

What every step shows (the picture, how it differs from rest, the flow, the head from near) becomes 96 numbers by
five layers of convolutions; three more over time, of growing reach, and their mean, maximum and spread over the clip
become 128. The network was trained once to tell gestures and 55 other motions of simulated people apart
(``tools/train_motion_net.py``), none of whom is in the shipped database. Only these numbers are used, as features among
others: a gesture is added by rows of a database, not by training the network again.
"""

from __future__ import annotations

import dataclasses
import functools
from collections.abc import Sequence
from importlib.resources import files

import numpy as np

from recognizer.networks.convolution import Layer, patches

FILE = "motion_net.npz"
REST = 3  # steps at the beginning whose mean picture is the person at rest
PICTURE_UNIT, FLOW_UNIT = 32.0, 4.0  # even-contrast levels, head heights per second, that count as 1
BRIGHTEST = 127.0  # even-contrast levels; more counts as much
HEAD_CELLS = 6  # in each direction, of the window HEAD
STRIDES = (2, 2, 1, 2, 2)  # of the convolutions over space
DILATIONS = (1, 2, 4)  # steps between what the convolutions over time read
FEATURES = 128


@dataclasses.dataclass(frozen=True)
class Look:
    """One step as the network reads it.

    Attributes:
        picture: (64, 80) the window [PICTURE_UNIT].
        flow: (16, 20, 3) root of the flow right, down and of its size, in cells of half a head height [FLOW_UNIT].
        head: (76,) root of the flow at the head, right and down in 6×6 cells, of the chest's velocity and of the head's
            place [head heights, and per second].
    """

    picture: np.ndarray
    flow: np.ndarray
    head: np.ndarray

    def mirrored(self) -> Look:
        """The look of the mirrored clip; as well of several looks, one above the other."""
        head = self.head.copy()
        across = head[..., :-4].reshape(*head.shape[:-1], 2, HEAD_CELLS, HEAD_CELLS)[..., ::-1]
        head[..., :-4] = across.reshape(*head.shape[:-1], -1)
        head[..., : HEAD_CELLS**2] *= -1
        head[..., -4::2] *= -1
        turned = self.flow[..., ::-1, :] * np.array([-1, 1, 1], np.float32)
        return Look(self.picture[..., ::-1], turned, head)


@dataclasses.dataclass(frozen=True)
class MotionNet:
    """The layers, in the order in which they are applied.

    The first was trained on two pictures, the window and how it differs from rest. It is linear before its offsets, so
    the window alone is read with the sum of both weights, and what rest takes away is worked out once a clip.
    """

    space: tuple[Layer, ...]
    rest: np.ndarray
    seen: Layer
    head: Layer
    time: tuple[Layer, ...]
    whole: Layer

    @classmethod
    def load(cls) -> MotionNet:
        """Read the shipped weights."""
        return _shipped()

    def first(self, rest: np.ndarray) -> Layer:
        """The first layer for a person whose window at rest is ``rest``, (64, 80) [PICTURE_UNIT]."""
        first = self.space[0]
        taken = patches(rest[None, ..., None], self.rest, STRIDES[0]) @ self.rest
        return Layer(first.weights, first.offsets - taken)

    def steps(self, looks: Sequence[Look], first: Layer) -> np.ndarray:
        """Numbers (m, 96) of m steps of one person; ``first`` as :meth:`first` gives it."""
        maps, flow = np.stack([look.picture for look in looks])[..., None], np.stack([look.flow for look in looks])
        for layer, stride in zip((first, *self.space[1:]), STRIDES, strict=True):
            if stride == 1:
                maps = np.concatenate([maps, flow], axis=-1)
            maps = layer(patches(maps, layer.weights, stride))
        head = self.head(np.stack([look.head for look in looks]))
        return np.concatenate([self.seen(maps.reshape(len(looks), -1)), head], axis=1)

    def clips(self, steps: np.ndarray) -> np.ndarray:
        """Numbers (m, 128) of m clips from those of their steps (m, n, 96), of which there is 1 at least."""
        found = self.time[0](_in_time(steps, DILATIONS[0]))
        for layer, dilation in zip(self.time[1:], DILATIONS[1:], strict=True):
            found = found + layer(_in_time(found, dilation))
        spread = np.sqrt(found.var(axis=1) + np.float32(1e-4))
        return self.whole(np.concatenate([found.mean(axis=1), found.max(axis=1), spread], axis=1))


def _in_time(steps: np.ndarray, dilation: int) -> np.ndarray:
    """Each step with two before and two after it, ``dilation`` apart: (m, n, c) to (m, n, 5·c); 0 beyond the ends."""
    count, n, size = steps.shape
    padded = np.zeros((count, n + 4 * dilation, size), np.float32)
    padded[:, 2 * dilation : 2 * dilation + n] = steps
    return np.concatenate([padded[:, k * dilation : k * dilation + n] for k in range(5)], axis=2)


@functools.cache
def _shipped() -> MotionNet:
    with files("recognizer.networks").joinpath(FILE).open("rb") as file, np.load(file, allow_pickle=False) as stored:
        arrays = {name: stored[name].astype(np.float32) for name in stored.files}

    def layer(name: str) -> Layer:
        return Layer(arrays[f"{name}_weights"], arrays[f"{name}_offsets"])

    first = arrays["space0_weights"].reshape(-1, 2, arrays["space0_offsets"].size)
    arrays["space0_weights"] = first.sum(axis=1)
    return MotionNet(
        tuple(layer(f"space{k}") for k in range(len(STRIDES))),
        first[:, 1],
        layer("seen"),
        layer("head"),
        tuple(layer(f"time{k}") for k in range(len(DILATIONS))),
        layer("whole"),
    )
