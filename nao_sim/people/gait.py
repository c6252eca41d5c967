"""Walking across the image: a stylised gait, good for silhouettes and optical flow, with no claim to dynamics."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.random import Generator

from nao_sim.people.motions import joints
from nao_sim.people.surface import Array

# Comfortable adult walking is about 0.75 statures a second with strides of 0.83 statures
# (Winter, Biomechanics and Motor Control of Human Gait, 1991).
SPEED_STATURES = 0.75
STRIDE_STATURES = 0.83


@dataclass(frozen=True)
class Walk:
    """A crossing along the person's y axis (image left is -y) from ``begin`` to ``end``, both in statures."""

    begin: float
    end: float
    start: float
    seconds: float
    swing: float
    phase: float

    @classmethod
    def draw(cls, sides: Any, half_width: float, stature: float, tempo: float, rng: Generator) -> Walk:
        """Draw a crossing from near one edge of the image (or beyond it) to near the other."""
        half = half_width / stature
        begin = sides[0] * half * rng.uniform(0.55, 1.2)
        end = sides[1] * half * rng.uniform(0.55, 1.2)
        seconds = abs(end - begin) / (SPEED_STATURES * tempo) + 0.2
        return cls(begin, end, 0.0, float(seconds), float(rng.uniform(0.7, 1.3)), float(rng.uniform(0, 2 * np.pi)))

    def delayed(self, lead: float) -> Walk:
        """The same walk, beginning ``lead`` seconds later."""
        return replace(self, start=lead)


def walk_angles(walk: Walk, times: Array, out: Array) -> None:
    """Lay ``walk`` over the angles ``out`` (n, nq; slides in statures) at ``times`` (n,) in place."""
    index = joints()
    share = np.clip((times - walk.start) / walk.seconds, 0.0, 1.0)
    # Even speed with a soft start and stop over a tenth of the way.
    ramp = np.clip(np.minimum(share, 1 - share) / 0.08, 0.0, 1.0)
    way = share + 0.02 * np.sin(2 * np.pi * share)
    travelled = (walk.end - walk.begin) * way
    phase = 2 * np.pi * np.abs(travelled) / STRIDE_STATURES + walk.phase
    out[:, index["root_y"]] += walk.begin + travelled
    out[:, index["root_yaw"]] += np.pi / 2 * np.sign(walk.end - walk.begin)
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
