"""The command layer: what a target goes through before it reaches a motor.

NAOqi's order: range check, anti-collision tables, then a set-point every 20 ms that gains speed no faster than the
motor can follow and never runs faster than its nominal speed. The motor boards interpolate between set-points.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import numpy as np
from numpy.typing import ArrayLike

from nao_sim.robot.anti_collision import clamp_pairs, hold_pairs
from nao_sim.robot.errors import AngleRangeError, TargetError
from nao_sim.robot.joints import ACTUATED, BODY, joint_table, resolve
from nao_sim.robot.tolerance import SOFTNESS_RAD

_FULL = np.ones(len(ACTUATED))
_FULL.setflags(write=False)


def _miscounted(values: np.ndarray, joints: tuple[str, ...]) -> str:
    """Say that there are not as many angles as joints; who gives one per motor for the body is told the name."""
    if values.shape == (len(ACTUATED),) and len(joints) == len(BODY):
        return f"{values.size} angles for the {len(BODY)} joints of 'Body'; one per motor is 'JointActuators'"
    return f"{values.size} angles for {len(joints)} joints ({', '.join(joints)}); give one each"


@lru_cache(maxsize=256)
def _actuators(names: tuple[str, ...]) -> tuple[tuple[str, ...], np.ndarray, np.ndarray | slice]:
    """Return, for joint or chain names, the joints, their actuator rows and the places of those rows' values."""
    joints = tuple(resolve(names))
    followers = {j.name: j.follows for j in joint_table().joints if j.follows is not None}
    rows, places = [], []
    for place, name in enumerate(joints):
        leader = followers.get(name, name)
        # One motor turns both HipYawPitch joints; as in NAOqi the left value counts when both are given.
        if leader != name and leader in joints:
            continue
        rows.append(ACTUATED.index(leader))
        places.append(place)
    return joints, np.array(rows), slice(None) if len(places) == len(joints) else np.array(places)


class CommandLayer:
    """Targets and set-points of the 25 motors.

    Attributes:
        limits: the name of the limit set.
        targets: ``(25,)`` where the joints are asked to go, inside ranges and tables.
        setpoint: ``(25,)`` what the motors are told now, on its rate-limited way to the targets.
        low, high: ``(25,)`` the joint ranges.
        max_speed: ``(25,)`` the motors' nominal speed, rad/s.
    """

    def __init__(self, limits: str, period: float) -> None:
        self.limits = limits
        table = joint_table().select(ACTUATED)
        self.low, self.high = table.range_rad(limits).T.copy()
        self.max_speed = table.max_speed_rad("nominal")
        # From here on in radians a period: what is added to a set-point.
        acceleration = np.array([joint.acceleration for joint in table.joints]) * period**2
        self._most, self._gain = self.max_speed * period, acceleration
        # Stopping takes v² / 2a, and the period it goes on before; solved for v.
        self._slow, self._slow_squared, self._brake = acceleration / 2, acceleration**2 / 4, 2 * acceleration
        self.reset(np.zeros(len(ACTUATED)))

    def reset(self, angles: np.ndarray) -> None:
        """Start from ``(25,)`` angles: targets and set-point alike."""
        self.targets = clamp_pairs(np.clip(angles, self.low, self.high))
        self.setpoint = self.targets.copy()
        self._travel = np.zeros(len(ACTUATED))
        self._share = _FULL

    def state(self) -> np.ndarray:
        """Return ``(100,)`` what the layer remembers: targets, set-point, its last travel, and shares of speed."""
        return np.concatenate([self.targets, self.setpoint, self._travel, self._share])

    def restore(self, state: np.ndarray) -> None:
        """Go on from what :meth:`state` returned."""
        remembered = np.array(state, dtype=float).reshape(4, len(ACTUATED))
        self.targets, self.setpoint, self._travel, self._share = remembered

    def set(self, names: str | Sequence[str], angles: ArrayLike, speed: float = 1.0) -> None:
        """Set the targets of some joints, rad (hands: open fraction).

        Args:
            names: a joint, a chain (``"Head"``, ``"LArm"``, ``"Body"`` ...), or a list of them.
            angles: one number for all of them, or one per joint.
            speed: share of their motors' nominal speed, above 0 and at most 1.

        Raises:
            UnknownNameError: no such joint or chain.
            TargetError: a wrong number of angles, one that is not finite, or no such share.
            AngleRangeError: an angle beyond its joint's range by more than the joints' own softness (what is nearer
                is put on the limit). Nothing is changed then.
        """
        joints, rows, places = _actuators((names,) if isinstance(names, str) else tuple(names))
        values = np.asarray(angles, dtype=float)
        if values.ndim == 0:
            values = np.full(len(joints), float(values))
        if values.shape != (len(joints),):
            raise TargetError(_miscounted(values, joints))
        if not 0 < speed <= 1:
            raise TargetError(f"a speed of {speed:g}; give a share of the nominal speed, above 0 and at most 1")
        targets = self.targets.copy()
        targets[rows] = values[places]
        share = self._share.copy()
        share[rows] = speed
        self.set_all(targets)
        self._share = share

    def set_all(self, targets: np.ndarray) -> None:
        """Set all ``(25,)`` targets at once, in ``ACTUATED`` order, at full speed; raises as :meth:`set` does."""
        targets = np.asarray(targets, dtype=float)
        if targets.shape != self.targets.shape:
            raise TargetError(f"targets have shape {targets.shape}; give {self.targets.shape}, one per motor")
        # fmax puts a number where there is none, so what is not finite differs, too. Bytes are quickest to compare.
        inside = np.fmin(np.fmax(targets, self.low), self.high)
        if inside.tobytes() != targets.tobytes():
            self._forgive(targets, inside)
        self.targets = clamp_pairs(inside)
        self._share = _FULL

    def _forgive(self, targets: np.ndarray, inside: np.ndarray) -> None:
        """Raise unless targets are outside by no more than the joints' own softness."""
        near = np.abs(inside - targets) <= SOFTNESS_RAD
        if near.all():
            return
        row = int(near.argmin())
        if not np.isfinite(targets[row]):
            raise TargetError(f"{ACTUATED[row]}: the target is not a finite number; give radians")
        low, high = float(self.low[row]), float(self.high[row])
        raise AngleRangeError(ACTUATED[row], float(targets[row]), low, high, self.limits)

    def advance(self) -> np.ndarray:
        """Move the set-point one control period towards the targets and return it, ``(25,)``.

        Its speed is at most the motor's nominal one, grows no faster than the joint's acceleration, and falls towards
        the ends of the range, so that no joint runs into its stop.
        """
        previous = self.setpoint
        setpoint, most = self.glide(previous, self.targets, self._travel)
        hold_pairs(previous, setpoint, self.targets, most)
        self._travel = np.abs(setpoint - previous)
        self.setpoint = setpoint
        return setpoint

    def glide(self, setpoint: np.ndarray, targets: np.ndarray, travel: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Return set-points one period later, anti-collision tables left out, and the most they could have travelled.

        Args:
            setpoint, targets: ``(..., 25)`` now, and where to.
            travel: ``(..., 25)`` how far the set-point went in the period before, rad.
        """
        most = np.minimum(self._most * self._share, travel + self._gain)
        change = targets - setpoint
        room = np.abs(np.where(change > 0, self.high, self.low) - setpoint)
        # A joint may run only as fast as it can still stop before the end of its range.
        reach = np.minimum(most, np.sqrt(self._slow_squared + self._brake * room) - self._slow)
        return setpoint + np.minimum(np.maximum(change, -reach), reach), most
