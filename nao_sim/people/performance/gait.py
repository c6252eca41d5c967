"""Walking across the image: a stylised gait, good for silhouettes and optical flow, with no claim to dynamics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.random import Generator

from nao_sim.people.arrays import Array
from nao_sim.people.performance.motions import joints

# Comfortable adult walking is about 0.75 statures a second with strides of 0.83 statures
# (Winter, Biomechanics and Motor Control of Human Gait, 1991).
SPEED_STATURES = 0.75
STRIDE_STATURES = 0.83


@dataclass(frozen=True)
class Walk:
    """A straight walk over the floor.

    Attributes:
        begin: where it begins, (x, y) in statures.
        length: how far it goes, statures.
        heading: where it goes, rad; 0 to the camera, a quarter turn to the image's right.
        start, seconds: when, and for how long.
        swing: factor on the swing of the arms.
        phase: of the stride at the beginning, rad.
    """

    begin: tuple[float, float]
    length: float
    heading: float
    start: float
    seconds: float
    swing: float
    phase: float

    @classmethod
    def draw(cls, step: Mapping[str, Any], half_width: float, stature: float, tempo: float, rng: Generator) -> Walk:
        """Draw a walk: ``walk`` from near one edge of the image (or beyond it) to near the other, ``approach`` towards
        the camera or away from it between two distances in front of where the person would stand, in statures."""
        if "walk" in step:
            half = half_width / stature
            begin, end = (side * half * rng.uniform(0.55, 1.2) for side in step["walk"])
            heading, place = np.pi / 2 * np.sign(end - begin), (0.0, begin)
        else:
            begin, end = (float(rng.uniform(*reach)) for reach in step["approach"])
            heading = (0.0 if end > begin else np.pi) + rng.normal(0, 0.12)
            place = (begin, float(rng.normal(0, 0.05)))
        length = abs(end - begin)
        seconds = length / (SPEED_STATURES * tempo) + 0.2
        swing, phase = float(rng.uniform(0.7, 1.3)), float(rng.uniform(0, 2 * np.pi))
        return cls(place, float(length), float(heading), 0.0, float(seconds), swing, phase)

    def delayed(self, lead: float) -> Walk:
        """The same walk, beginning ``lead`` seconds later."""
        return replace(self, start=lead)


def walk_angles(walk: Walk, times: Array, out: Array) -> None:
    """Lay ``walk`` over the angles ``out`` (n, nq; slides in statures) at ``times`` (n,) in place."""
    index = joints()
    share = np.clip((times - walk.start) / walk.seconds, 0.0, 1.0)
    # Even speed with a soft start and stop over a tenth of the way.
    ramp = np.clip(np.minimum(share, 1 - share) / 0.08, 0.0, 1.0)
    travelled = walk.length * (share + 0.02 * np.sin(2 * np.pi * share))
    phase = 2 * np.pi * travelled / STRIDE_STATURES + walk.phase
    out[:, index["root_x"]] += walk.begin[0] + travelled * np.cos(walk.heading)
    out[:, index["root_y"]] += walk.begin[1] + travelled * np.sin(walk.heading)
    out[:, index["root_yaw"]] += walk.heading
    for side, shift in (("r_", 0.0), ("l_", np.pi)):
        swing = np.sin(phase + shift)
        lifted = np.maximum(0.0, np.cos(phase + shift)) ** 1.5
        out[:, index[f"{side}hip_flex"]] += np.radians(26) * swing * ramp
        out[:, index[f"{side}knee"]] += np.radians(6 + 52 * lifted) * ramp
        out[:, index[f"{side}ankle"]] += np.radians(8 * swing) * ramp
        out[:, index[f"{side}shoulder_flex"]] -= np.radians(22) * swing * walk.swing * ramp
        out[:, index[f"{side}elbow"]] += np.radians(10 + 8 * swing) * walk.swing * ramp
    out[:, index["root_z"]] += -0.008 * ramp * (1 - np.cos(2 * phase))
    out[:, index["chest_yaw"]] += np.radians(6) * np.sin(phase) * ramp
