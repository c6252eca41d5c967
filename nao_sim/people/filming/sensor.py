"""What a cheap camera does to a picture: white balance, exposure drift, flicker, lens blur and noise."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.random import Generator

from nao_sim.people.arrays import Array, Image

# Noise is cut at random places from one field per clip, which costs a tenth of drawing it anew.
_FIELD_MARGIN = 64


@dataclass(frozen=True)
class Sensor:
    """Settings of one clip; see ``assets/people/cameras.toml``.

    Attributes:
        gain: factors (3,) of B, G and R.
        gamma: exponent on top of the display's.
        veil: grey level of black: stray light and automatic gain lift it.
        drift: rows (amplitude, Hz, phase) of the slow exposure change.
        flicker: amplitude and Hz as sampled by the frame rate.
        noise: standard deviation, grey levels at middle grey.
        blur: standard deviation of the lens blur, pixels at a width of 320.
        shutter: share of the frame time that the shutter is open.
        quality: JPEG quality of the stored clip.
        seed: of the noise.
    """

    gain: Array
    gamma: float
    veil: float
    drift: Array
    flicker: tuple[float, float]
    noise: float
    blur: float
    shutter: float
    quality: int
    seed: int

    @classmethod
    def draw(cls, table: Mapping[str, Any], rng: Generator) -> Sensor:
        """Draw the settings of a clip from the ranges of the camera file; a share of the clips is dimly lit."""
        if "dim" in table and rng.random() < table["dim"]["share"]:
            table = {**table, **table["dim"]}
        lit = rng.random() < table["flicker_share"]
        drift = np.stack([rng.normal(0, table["drift"], 2), rng.uniform(0.05, 0.6, 2), rng.uniform(0, 6.28, 2)], axis=1)
        return cls(
            gain=rng.uniform(*table["gain"]) * (1 + rng.normal(0, table["cast"], 3)),
            gamma=float(rng.uniform(*table["gamma"])),
            veil=float(rng.uniform(*table["veil"])) if "veil" in table else 0.0,
            drift=drift,
            flicker=(float(rng.uniform(*table["flicker"])) if lit else 0.0, float(rng.uniform(0.3, 6))),
            noise=float(rng.uniform(*table["noise"])),
            blur=float(rng.uniform(*table["blur"])),
            shutter=float(rng.uniform(*table["shutter"])),
            quality=int(rng.integers(table["quality"][0], table["quality"][1] + 1)),
            seed=int(rng.integers(2**31)),
        )


class Exposure:
    """Applies a :class:`Sensor` to the frames of one clip."""

    def __init__(self, sensor: Sensor, width: int, height: int) -> None:
        self._sensor = sensor
        self._rng = np.random.default_rng(sensor.seed)
        self._sigma = sensor.blur * width / 320
        shape = (height + _FIELD_MARGIN, width + _FIELD_MARGIN, 3)
        field = self._rng.standard_normal(shape, dtype=np.float32) * sensor.noise
        # Chroma noise is weaker than luma noise, and sensors blur it.
        field = 0.6 * field + 0.4 * field.mean(axis=2, keepdims=True) * np.sqrt(3)
        # Adding what brightens and subtracting what darkens is four times as fast as adding signed numbers.
        self._brighter, self._darker = (np.round(np.maximum(part, 0)).astype(np.uint8) for part in (field, -field))
        self._levels = (np.arange(256) / 255) ** sensor.gamma * 255

    def develop(self, rgb: Image, time: float) -> Image:
        """BGR frame (h, w, 3) that the camera delivers of an RGB image at ``time`` (s)."""
        sensor = self._sensor
        amplitude, rate = sensor.flicker
        level = 1 + amplitude * np.sin(2 * np.pi * rate * time)
        level += (sensor.drift[:, 0] * np.sin(2 * np.pi * sensor.drift[:, 1] * time + sensor.drift[:, 2])).sum()
        lit = np.clip(self._levels[:, None] * sensor.gain * level, 0, 255)
        table = (sensor.veil + lit * (1 - sensor.veil / 255)).astype(np.uint8)
        frame = cv2.LUT(cv2.cvtColor(rgb, cv2.COLOR_RGB2BGR), table[None])
        if self._sigma > 0.25:
            frame = cv2.GaussianBlur(frame, (0, 0), self._sigma)
        height, width = frame.shape[:2]
        y, x = self._rng.integers(0, _FIELD_MARGIN, 2)
        place = slice(y, y + height), slice(x, x + width)
        return np.asarray(cv2.subtract(cv2.add(frame, self._brighter[place]), self._darker[place]), dtype=np.uint8)
