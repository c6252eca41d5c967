"""From key frames to a trajectory: pace, size, repetitions, easing, legs, and the time that the motors need."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures.errors import GestureError
from nao_sim.gestures.key_frames import TORSO_KEYS, KeyFrame, Written
from nao_sim.motion.easing import ease
from nao_sim.motion.limits import HANDS, Change, clipped, stretched
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.motion.whole_body import LEG_JOINTS, TorsoPath, plant_feet, standing_torso
from nao_sim.robot.joints import ACTUATED
from nao_sim.robot.postures import posture

SPEEDS = (0.1, 4.0)
AMPLITUDES = (0.1, 2.0)
REST = "StandInit"
# Joints that the gesture does not name come home from wherever the last one left them, within this time.
_HOMING_S = 1.0
_SAME_RAD = 1e-3
# How many joints lie between the shoulder and this one; each follows a little later than the one before.
_DEPTH = {"ElbowYaw": 1, "ElbowRoll": 1, "WristYaw": 2, "Hand": 2}


@dataclass(frozen=True)
class Prepared:
    """A gesture ready to play: its trajectory, and what had to change for the motors (empty: nothing)."""

    trajectory: Trajectory
    changes: list[Change]


def prepare(
    gesture: Written,
    start: str | Mapping[str, float] = REST,
    speed: float = 1.0,
    amplitude: float = 1.0,
    repetitions: int | None = None,
    limits: str = "thesis",
) -> Prepared:
    """Turn a gesture into targets that the motors can follow: as :func:`written`, clipped and slowed where needed.

    Args:
        gesture, start, speed, amplitude, repetitions: see :func:`written`.
        limits: ``"thesis"``, ``"v5"`` or ``"envelope"``.

    Raises:
        GestureError: as :func:`written`.
    """
    inside, clips = clipped(written(gesture, start, speed, amplitude, repetitions), limits)
    slower, stretches = stretched(inside, limits)
    return Prepared(slower, clips + stretches)


def written(
    gesture: Written,
    start: str | Mapping[str, float] = REST,
    speed: float = 1.0,
    amplitude: float = 1.0,
    repetitions: int | None = None,
) -> Trajectory:
    """Turn a gesture into targets for the 25 joints, every 20 ms, whether the motors can follow or not.

    Args:
        gesture: what to do; must have key frames.
        start: where the robot is: a posture's name, or NAOqi joint → rad.
        speed: 2 is twice as fast.
        amplitude: 1.2 is a fifth larger. A repeated part grows about its own middle, so that a wave gets wider and
            not higher; anything else grows away from StandInit.
        repetitions: of the cycle; None for the gesture's own.

    Raises:
        GestureError: a walking gesture, or a speed, amplitude or number of repetitions out of bounds.
        MotionError: no stance on both feet carries it.
    """
    if gesture.walk is not None:
        raise GestureError(f"'{gesture.name}' is a walk; it is played, not turned into a fixed trajectory")
    _between("speed", speed, SPEEDS)
    _between("amplitude", amplitude, AMPLITUDES)
    frames = _repeated(_scaled(_homed(gesture), gesture, amplitude), gesture, repetitions)
    frames = [replace(frame, time_s=frame.time_s / speed) for frame in frames]
    first = _start_angles(start)
    frames = _led_in(frames, first)
    times, targets = _joint_curves(gesture, frames, first, gesture.follow_through_s / speed)
    if not set(gesture.joints) & set(LEG_JOINTS):
        targets = plant_feet(times, targets, _torso_path(gesture, frames, times))
    elif any(frame.torso for frame in frames):
        raise GestureError(f"'{gesture.name}' names both leg joints and the torso; keep one of them")
    return Trajectory(times, targets, marks={frame.mark: frame.time_s for frame in frames if frame.mark is not None})


def _between(what: str, value: float, allowed: tuple[float, float]) -> None:
    if not allowed[0] <= value <= allowed[1]:
        raise GestureError(f"{what} is {value:g}; choose one from {allowed[0]:g} to {allowed[1]:g}")


def _led_in(frames: list[KeyFrame], start: NDArray[np.float64]) -> list[KeyFrame]:
    """Return the key frames later, if the first is at time 0 and elsewhere than the robot, so that it can get there."""
    asked = frames[0].angles_rad if frames[0].time_s < CONTROL_PERIOD else {}
    if all(abs(value - start[ACTUATED.index(name)]) < _SAME_RAD for name, value in asked.items()):
        return frames
    return [replace(frame, time_s=frame.time_s + _HOMING_S) for frame in frames]


def _start_angles(start: str | Mapping[str, float]) -> NDArray[np.float64]:
    """Return the 25 starting targets, rad; what a mapping does not name is as in StandInit."""
    if isinstance(start, str):
        return np.array([posture(start)[name] for name in ACTUATED])
    return np.array([start.get(name, posture(REST)[name]) for name in ACTUATED])


def _homed(gesture: Written) -> list[KeyFrame]:
    """Return the key frames with every ``rest`` written out."""
    home = posture(REST)
    pitch, _ = standing_torso()
    pose = {name: home[name] for name in gesture.joints}
    used = {key for frame in gesture.key_frames for key in frame.torso}
    torso = {key: value for key, value in {"pitch": pitch, "roll": 0.0, "height": 0.0}.items() if key in used}
    return [replace(frame, angles_rad=pose, torso=torso) if frame.rest else frame for frame in gesture.key_frames]


def _marked(frames: list[KeyFrame], mark: str) -> int:
    return next(index for index, frame in enumerate(frames) if frame.mark == mark)


def _scaled(frames: list[KeyFrame], gesture: Written, amplitude: float) -> list[KeyFrame]:
    """Return the key frames larger or smaller."""
    if amplitude == 1.0:
        return frames
    home = posture(REST)
    middle = {name: home[name] for name in gesture.joints}
    first, last = 0, len(frames) - 1
    if gesture.cycle is not None:
        first, last = _marked(frames, gesture.cycle.first), _marked(frames, gesture.cycle.last)
        for name in gesture.joints:
            seen = [frame.angles_rad[name] for frame in frames[first : last + 1] if name in frame.angles_rad]
            if seen:
                middle[name] = (max(seen) + min(seen)) / 2
    upright = {"pitch": standing_torso()[0], "roll": 0.0, "height": 0.0}
    chosen = gesture.amplitude_joints or tuple(name for name in gesture.joints if name not in HANDS)

    def grow(frame: KeyFrame) -> KeyFrame:
        angles = {
            name: middle[name] + amplitude * (value - middle[name]) if name in chosen else value
            for name, value in frame.angles_rad.items()
        }
        torso = {key: upright[key] + amplitude * (value - upright[key]) for key, value in frame.torso.items()}
        return replace(frame, angles_rad=angles, torso=torso)

    return [grow(frame) if first <= index <= last else frame for index, frame in enumerate(frames)]


def _repeated(frames: list[KeyFrame], gesture: Written, repetitions: int | None) -> list[KeyFrame]:
    """Return the key frames with the cycle played as often as asked; marks stay with the first round."""
    if gesture.cycle is None:
        if repetitions not in (None, 1):
            raise GestureError(f"'{gesture.name}' has no repeated part; leave the repetitions out")
        return frames
    rounds = gesture.cycle.repetitions if repetitions is None else repetitions
    if not 1 <= rounds <= 100:
        raise GestureError(f"{rounds} repetitions; choose from 1 to 100")
    first, last = _marked(frames, gesture.cycle.first), _marked(frames, gesture.cycle.last)
    period = frames[last].time_s - frames[first].time_s
    out = frames[: last + 1]
    for turn in range(1, rounds):
        out = out + [
            replace(frame, time_s=frame.time_s + turn * period, mark=None) for frame in frames[first + 1 : last + 1]
        ]
    later = (rounds - 1) * period
    return out + [replace(frame, time_s=frame.time_s + later) for frame in frames[last + 1 :]]


def _joint_curves(
    gesture: Written, frames: list[KeyFrame], start: NDArray[np.float64], follow_s: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return times (n,) and targets (n, 25) of all joints, legs as in StandInit unless the gesture names them."""
    delays = {name: follow_s * _DEPTH.get(name[1:], 0) for name in gesture.joints}
    end = max(frames[-1].time_s, CONTROL_PERIOD) + max(delays.values(), default=0.0)
    count = int(np.ceil(end / CONTROL_PERIOD - 1e-9)) + 1
    times = np.asarray(np.arange(count) * CONTROL_PERIOD, dtype=np.float64)
    home = posture(REST)
    targets = np.empty((len(times), len(ACTUATED)))
    for column, name in enumerate(ACTUATED):
        keys = [(0.0, start[column])]
        for frame in frames:
            if name in frame.angles_rad:
                _put(keys, frame.time_s + (delays[name] if frame.time_s > 0 else 0.0), frame.angles_rad[name])
        if name not in delays and abs(start[column] - home[name]) > 1e-9:
            _put(keys, min(_HOMING_S, end), home[name])
        key_times, values = (np.array(row) for row in zip(*keys, strict=True))
        targets[:, column] = ease(key_times, values, times, gesture.easing)
    return times, targets


def _put(keys: list[tuple[float, float]], time: float, value: float) -> None:
    """Append a key, unless it repeats where the robot is at the very start."""
    if time > keys[-1][0]:
        keys.append((time, value))


def _torso_path(gesture: Written, frames: list[KeyFrame], times: NDArray[np.float64]) -> TorsoPath:
    """Return where the torso is at each time."""
    pitch, _ = standing_torso()
    curves = {}
    for key, standing in zip(TORSO_KEYS, (pitch, 0.0, 0.0), strict=True):
        keys = [(0.0, standing)]
        for frame in frames:
            if key in frame.torso:
                _put(keys, frame.time_s, frame.torso[key])
        key_times, values = (np.array(row) for row in zip(*keys, strict=True))
        curves[key] = ease(key_times, values, times, gesture.easing)
    return TorsoPath(curves["pitch"], curves["roll"], curves["height"])
