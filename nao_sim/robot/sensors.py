"""What the robot feels: inertial unit, foot force sensors, bumpers, touch, sonar (thesis app. 1; S15)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import mujoco
import numpy as np

from nao_sim.robot.sonar import Sonar
from nao_sim.robot.wiring import Wiring

FSR = ("LFsrFL", "LFsrFR", "LFsrRL", "LFsrRR", "RFsrFL", "RFsrFR", "RFsrRL", "RFsrRR")
"""The eight foot force sensors: left foot first; front/rear, left/right."""

BUMPERS = ("LFootBumperLeft", "LFootBumperRight", "RFootBumperLeft", "RFootBumperRight")
TOUCH = (
    "HeadTouchFront",
    "HeadTouchMiddle",
    "HeadTouchRear",
    "LHandTouchBack",
    "LHandTouchLeft",
    "LHandTouchRight",
    "RHandTouchBack",
    "RHandTouchLeft",
    "RHandTouchRight",
)


@dataclass(frozen=True)
class SensorReadings:
    """One moment of all sensors but the joints' and the cameras'.

    Attributes:
        gyro: ``(3,)`` angular velocity in the torso frame, rad/s (the thesis's robot has x and y only).
        accel: ``(3,)`` specific force in the torso frame, m/s²; about +9.81 along z when it stands.
        torso_rpy: ``(3,)`` roll, pitch, yaw of the torso, rad, rotations about the fixed x, y, z in that order.
        fsr: ``(8,)`` newtons, in ``FSR`` order.
        bumpers: name -> pressed.
        touch: name -> touched.
        sonar: ``"Left"`` and ``"Right"`` -> metres to the nearest echo; the greatest range when nothing answers.
    """

    gyro: np.ndarray
    accel: np.ndarray
    torso_rpy: np.ndarray
    fsr: np.ndarray
    bumpers: Mapping[str, bool]
    touch: Mapping[str, bool]
    sonar: Mapping[str, float]


class SensorReader:
    """Reads the sensors of one model; addresses are looked up once."""

    def __init__(self, wiring: Wiring) -> None:
        self._fsr = consecutive([wiring.sensor(name) for name in FSR])
        self._bumpers = np.array([wiring.sensor(name) for name in BUMPERS])
        self._touch = np.array([wiring.sensor(name) for name in TOUCH])
        self._gyro = wiring.sensor("Gyrometer")
        self._accel = wiring.sensor("Accelerometer")
        self._quat = wiring.sensor("TorsoOrientation")
        self._sonar = Sonar(wiring)

    def gyro(self, data: mujoco.MjData) -> np.ndarray:
        """Return the ``(3,)`` angular velocity in the torso's frame, rad/s."""
        return data.sensordata[self._gyro : self._gyro + 3].copy()

    def fsr(self, data: mujoco.MjData) -> np.ndarray:
        """Return the ``(8,)`` foot forces in N, in ``FSR`` order."""
        return data.sensordata[self._fsr].copy()

    def read(self, data: mujoco.MjData) -> SensorReadings:
        """Return all sensors now."""
        values = data.sensordata
        return SensorReadings(
            gyro=self.gyro(data),
            accel=values[self._accel : self._accel + 3].copy(),
            torso_rpy=roll_pitch_yaw(values[self._quat : self._quat + 4]),
            fsr=values[self._fsr].copy(),
            bumpers=dict(zip(BUMPERS, (values[self._bumpers] > 0).tolist(), strict=True)),
            touch=dict(zip(TOUCH, (values[self._touch] > 0).tolist(), strict=True)),
            sonar=self._sonar.read(data),
        )


def consecutive(ids: list[int]) -> slice | np.ndarray:
    """Return a slice where the ids allow it; it reads and writes several times faster than a list of them."""
    if ids == list(range(ids[0], ids[0] + len(ids))):
        return slice(ids[0], ids[0] + len(ids))
    return np.array(ids)


def roll_pitch_yaw(quat: np.ndarray) -> np.ndarray:
    """Return ``(3,)`` roll, pitch, yaw in rad of a ``(4,)`` unit quaternion w, x, y, z."""
    w, x, y, z = quat
    return np.array(
        [
            np.arctan2(2 * (w * x + y * z), 1 - 2 * (x * x + y * y)),
            np.arcsin(np.clip(2 * (w * y - z * x), -1, 1)),
            np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z)),
        ]
    )
