"""Closed-form inverse kinematics of NAO's legs, with the one motor that turns both HipYawPitch joints.

A leg is HipYawPitch, HipRoll, HipPitch, KneePitch, AnklePitch, AnkleRoll; the three hip axes meet in one point, and so
do the two ankle axes, so a sole's pose gives all six angles in closed form (axes of ``joints.toml``, S15). The two hips
share a motor: eleven motors cannot put two soles into two arbitrary poses. What is free here is the torso's heading: it
is turned until both legs ask for the same HipYawPitch, and then both soles are exact.

All functions take any leading batch shape. Torso and soles are given in one frame with z up; rad and m.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import numpy as np
from numpy.typing import NDArray

from nao_sim.robot.joints import ACTUATED, joint_table

SOLE_BELOW_ANKLE_M = 0.04519  # FootHeight, where the model's sole sites are
LEG_JOINTS = ("HipYawPitch", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll")
# The 11 leg motors among the 25, left leg first; the right leg has no HipYawPitch of its own.
LEG_COLUMNS = np.array([ACTUATED.index(n) for n in ACTUATED if any(part in n for part in ("Hip", "Knee", "Ankle"))])
_HEADING_STEPS = 4
# A heading change of 1 opens the hip on that side by about √2 and closes the other by as much: 1 / 2√2.
_SLOPE = 0.35
_SIDES = ("L", "R")


@dataclass(frozen=True)
class Lengths:
    """Hip places in the torso frame ``(2, 3)``, left first, and the lengths of thigh and tibia."""

    hips: NDArray[np.float64]
    thigh: float
    tibia: float


@cache
def lengths() -> Lengths:
    """Return the leg lengths of the joint table, m."""
    table = joint_table()
    hips = np.array([table[f"{side}HipYawPitch"].pos_m for side in _SIDES])
    return Lengths(hips, -table["LKneePitch"].pos_m[2], -table["LAnklePitch"].pos_m[2])


def rotation(axis: int, angle: NDArray[np.float64] | float) -> NDArray[np.float64]:
    """Return rotations about x (0), y (1) or z (2), shape (..., 3, 3)."""
    angle = np.asarray(angle, dtype=float)
    c, s = np.cos(angle), np.sin(angle)
    out = np.zeros((*angle.shape, 3, 3))
    i, j = (axis + 1) % 3, (axis + 2) % 3
    out[..., axis, axis] = 1.0
    out[..., i, i] = out[..., j, j] = c
    out[..., i, j], out[..., j, i] = -s, s
    return out


def _times(matrix: NDArray[np.float64], vector: NDArray[np.float64]) -> NDArray[np.float64]:
    return (matrix @ vector[..., None])[..., 0]


def _transposed(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return np.swapaxes(matrix, -1, -2)


def _tilt(side: int) -> tuple[NDArray[np.float64], float, float]:
    """Return the rotation about x that makes the HipYawPitch axis vertical, its angle, and the sign that it gives."""
    angle = -np.pi / 4 if side == 0 else np.pi / 4
    return rotation(0, angle), angle, -1.0 if side == 0 else 1.0


def _knee(distance: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the knee's flexion for a hip-to-ankle distance; the nearest reachable one if it is out of reach."""
    size = lengths()
    cosine = (distance**2 - size.thigh**2 - size.tibia**2) / (2 * size.thigh * size.tibia)
    return np.arccos(np.clip(cosine, -1.0, 1.0))


def hip_yaw_pitch(side: int, ankle: NDArray[np.float64], foot: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return the HipYawPitch that a leg would need for its foot's full orientation.

    Args:
        side: 0 left, 1 right.
        ankle: the ankle in the torso frame, shape (..., 3).
        foot: the foot's orientation in the torso frame, shape (..., 3, 3).
    """
    size = lengths()
    hip = _times(_transposed(foot), size.hips[side] - ankle)  # the hip as the foot sees it
    ankle_roll = np.arctan2(hip[..., 1], hip[..., 2])
    height = np.hypot(hip[..., 1], hip[..., 2])
    knee = _knee(np.linalg.norm(hip, axis=-1))
    back = np.arctan2(-size.thigh * np.sin(knee), size.tibia + size.thigh * np.cos(knee))
    ankle_pitch = back - np.arctan2(hip[..., 0], height)
    hips = foot @ _transposed(rotation(1, knee + ankle_pitch) @ rotation(0, ankle_roll))
    tilt, _, sign = _tilt(side)
    level = tilt @ hips
    return sign * np.arctan2(-level[..., 0, 1], level[..., 1, 1])


def leg_angles(
    side: int, ankle: NDArray[np.float64], up: NDArray[np.float64], hip_yaw: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return HipRoll … AnkleRoll for a given HipYawPitch: ankle in its place, sole facing down.

    Args:
        side: 0 left, 1 right.
        ankle: the ankle in the torso frame, shape (..., 3).
        up: the sole's normal, pointing up, in the torso frame, shape (..., 3).
        hip_yaw: HipYawPitch, shape (...).

    Returns:
        Angles, shape (..., 5). The foot's heading follows from HipYawPitch.
    """
    size = lengths()
    tilt, _, sign = _tilt(side)
    pelvis = _transposed(tilt) @ rotation(2, sign * hip_yaw) @ tilt
    leg = _times(_transposed(pelvis), ankle - size.hips[side])
    roll = np.arctan2(leg[..., 1], -leg[..., 2])
    knee = _knee(np.linalg.norm(leg, axis=-1))
    forward = np.arctan2(size.tibia * np.sin(knee), size.thigh + size.tibia * np.cos(knee))
    pitch = np.arctan2(-leg[..., 0], np.hypot(leg[..., 1], leg[..., 2])) - forward
    tibia = pelvis @ rotation(0, roll) @ rotation(1, pitch + knee)
    normal = _times(_transposed(tibia), up)
    ankle_pitch = np.arctan2(normal[..., 0], normal[..., 2])
    ankle_roll = -np.arcsin(np.clip(normal[..., 1], -1.0, 1.0))
    return np.stack([roll, pitch, knee, ankle_pitch, ankle_roll], axis=-1)


def solve_legs(
    torso: NDArray[np.float64], roll: NDArray[np.float64], pitch: NDArray[np.float64], feet: NDArray[np.float64]
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return the leg motors' angles that put both soles flat into their places.

    Args:
        torso: torso origin, shape (..., 3).
        roll, pitch: torso lean about x and y after its heading, shape (...).
        feet: x, y, z, heading of both soles, left first, shape (..., 2, 4).

    Returns:
        Angles of the 11 leg motors in ``LEG_COLUMNS`` order, shape (..., 11), and the torso's heading, shape (...).
    """
    lean = rotation(1, pitch) @ rotation(0, roll)
    ankles = feet[..., :3] + [0.0, 0.0, SOLE_BELOW_ANKLE_M]

    def hips_at(heading: NDArray[np.float64]) -> NDArray[np.float64]:
        world = _transposed(rotation(2, heading) @ lean)
        return np.stack(
            [
                hip_yaw_pitch(
                    side, _times(world, ankles[..., side, :] - torso), world @ rotation(2, feet[..., side, 3])
                )
                for side in (0, 1)
            ],
            axis=-1,
        )

    heading = feet[..., 3].mean(axis=-1)
    hips = hips_at(heading)
    for _ in range(_HEADING_STEPS):
        heading = heading + (hips[..., 1] - hips[..., 0]) * _SLOPE
        hips = hips_at(heading)
    world = _transposed(rotation(2, heading) @ lean)
    hip_yaw = hips.mean(axis=-1)
    legs = [leg_angles(s, _times(world, ankles[..., s, :] - torso), world[..., :, 2], hip_yaw) for s in (0, 1)]
    return np.concatenate([hip_yaw[..., None], *legs], axis=-1), heading
