"""A small convolutional network that tells what the hand in a window shows: a posture, another hand, or none.

A hand of forty pixels before a bookcase cannot be divided from it by colour alone, and a weighted sum of its edges says
too little of how fingers lie. Seven layers of convolutions and two more were trained on photos of simulated people
(``tools/film_hands.py``, ``tools/train_hand_net.py``); none of them is one on whom figures are reported.
"""

from __future__ import annotations

import functools
from importlib.resources import files
from typing import NamedTuple

import numpy as np

from recognizer.networks.convolution import Layer, patches
from recognizer.postures.person.windows import lab
from recognizer.postures.types import Image

FILE = "hand_net.npz"
HAND, SIDE = 48, 80  # pixels of a hand's length and of the window's side
CHANNELS = 4
STRIDES = (2, 1, 2, 1, 2, 1, 2)  # of the convolutions
PALM_AT = (0.0, 0.18)  # hand lengths right and down of the window's middle, the middle finger's knuckle
PALM_RADIUS = 0.115  # hand lengths
UNITS = (20.0, 10.0, 10.0)  # L*, a*, b* beyond the palm's that count as 1
MOST = 3.0  # units or deviations; more counts as much
LEAST_SPREAD = 3.0  # L*: flatter windows are not stretched further


def palm_pixels(hand: float, side: int) -> np.ndarray:
    """Return which pixels (side, side) of a window are palm for sure, if it stands over a hand; ``hand`` in pixels."""
    rows, columns = np.indices((side, side))
    right, down = side / 2 + np.array(PALM_AT) * hand
    return np.asarray(np.hypot(columns - right, rows - down) < PALM_RADIUS * hand)


_PALM = palm_pixels(HAND, SIDE)


def look(window: Image) -> np.ndarray:
    """Return what the network reads of a window (80, 80, 3), (80, 80, 4) float32.

    Lightness less its mean over its deviation, and the colour beyond the palm's: what a hand is made of, whoever's it
    is and whatever the light.
    """
    colours = lab(window)
    light = colours[..., 0]
    spread = max(float(light.std()), LEAST_SPREAD)
    palm = np.median(colours[_PALM], axis=0)
    out = np.empty((*light.shape, CHANNELS), np.float32)
    out[..., 0] = (light - light.mean()) / spread
    out[..., 1:] = (colours - palm) / np.array(UNITS, np.float32)
    return np.clip(out, -MOST, MOST, out=out)


class HandNet(NamedTuple):
    """The layers, in the order in which they are applied.

    Attributes:
        space: convolutions.
        whole: what all of the window becomes.
        name, name_offsets: (d, c) and (c,); weights of what is named.
        classes: (c,) postures, "irrelevant ..." for other hands, "no hand".
    """

    space: tuple[Layer, ...]
    whole: Layer
    name: np.ndarray
    name_offsets: np.ndarray
    classes: tuple[str, ...]

    @classmethod
    def load(cls) -> HandNet:
        """Read the shipped weights."""
        return _shipped()

    def __call__(self, looks: np.ndarray) -> np.ndarray:
        """Logarithms (m, c), but for a constant of each row, of the classes' shares in m looks (m, 80, 80, 4)."""
        maps = looks
        for layer, stride in zip(self.space, STRIDES, strict=True):
            maps = layer(patches(maps, layer.weights, stride))
        named: np.ndarray = self.whole(maps.reshape(len(maps), -1)) @ self.name + self.name_offsets
        return named


@functools.cache
def _shipped() -> HandNet:
    with (
        files("recognizer.postures.person").joinpath(FILE).open("rb") as file,
        np.load(file, allow_pickle=False) as stored,
    ):
        arrays = {name: stored[name] for name in stored.files}
    classes = tuple(str(name) for name in arrays.pop("classes"))
    weights = {name: values.astype(np.float32) for name, values in arrays.items()}
    layers = {
        name.removesuffix("_weights"): Layer(weights[name], weights[name.replace("_weights", "_offsets")])
        for name in weights
        if name.endswith("_weights")
    }
    space = tuple(layers[f"space{k}"] for k in range(len(STRIDES)))
    return HandNet(space, layers["whole"], *layers["name"], classes)
