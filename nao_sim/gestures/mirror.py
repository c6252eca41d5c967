"""A gesture with left and right exchanged.

NAOqi's rule: joints exchange their L and R; angles about the roll (x) and yaw (z) axes change sign, angles about the
pitch (y) axis and hands do not. HipYawPitch is one motor for both sides and keeps its value.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.key_frames import KeyFrame, Walk
from nao_sim.gestures.vocabulary import vocabulary
from nao_sim.motion.trajectory import Trajectory
from nao_sim.robot.joints import ACTUATED

_SINGLE_MOTOR = ("LHipYawPitch", "RHipYawPitch")


def mirrored_joint(name: str) -> str:
    """Return the joint on the other side; head joints and HipYawPitch are their own."""
    if name.startswith("Head") or name in _SINGLE_MOTOR:
        return name
    return {"L": "R", "R": "L"}[name[0]] + name[1:]


def mirror_sign(name: str) -> float:
    """Return -1 for a roll or yaw joint, 1 for a pitch joint, a hand or HipYawPitch."""
    if name in _SINGLE_MOTOR:
        return 1.0
    return -1.0 if name.endswith(("Roll", "Yaw")) else 1.0


def mirrored_angles(angles: Mapping[str, float]) -> dict[str, float]:
    """Return the angles (any unit, hands included) of the mirrored pose."""
    return {mirrored_joint(name): mirror_sign(name) * value + 0.0 for name, value in angles.items()}


def mirrored(gesture: Gesture) -> Gesture:
    """Return the gesture with left and right exchanged, under its mirror name; mirroring twice gives it back."""
    twin = vocabulary().get(gesture.mirror)
    return replace(
        gesture,
        name=gesture.mirror,
        mirror=gesture.name,
        number=twin.number if twin else (gesture.number if gesture.mirror == gesture.name else None),
        title=twin.title if twin else _mirrored_words(gesture.title),
        key_frames=tuple(_mirrored_frame(frame) for frame in gesture.key_frames),
        amplitude_joints=tuple(mirrored_joint(name) for name in gesture.amplitude_joints),
        walk=_mirrored_walk(gesture.walk),
    )


def mirrored_trajectory(trajectory: Trajectory) -> Trajectory:
    """Return the trajectory with left and right exchanged."""
    source = [ACTUATED.index(mirrored_joint(name)) for name in ACTUATED]
    signs: NDArray[np.float64] = np.array([mirror_sign(name) for name in ACTUATED])
    return Trajectory(trajectory.times, trajectory.targets[:, source] * signs + 0.0, marks=dict(trajectory.marks))


def _mirrored_frame(frame: KeyFrame) -> KeyFrame:
    torso = {key: -value + 0.0 if key == "roll" else value for key, value in frame.torso.items()}
    return replace(frame, angles_rad=mirrored_angles(frame.angles_rad), torso=torso)


def _mirrored_walk(walk: Walk | None) -> Walk | None:
    return None if walk is None else Walk(walk.x, -walk.y + 0.0, -walk.turn + 0.0)


def _mirrored_words(text: str) -> str:
    """Exchange the words left and right, and the two senses of rotation."""
    swap = {"left": "right", "right": "left", "Left": "Right", "Right": "Left"}
    swap |= {"clockwise": "counter-clockwise", "counter-clockwise": "clockwise"}
    return re.sub(r"[A-Za-z-]+", lambda word: swap.get(word[0], word[0]), text)
