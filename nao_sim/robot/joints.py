"""The joint table: NAOqi's 26 names, their ranges, motors and chains (thesis, tables A1-1 to A1-3; S15).

The numbers live in ``assets/nao/joints.toml`` and ``motors.toml``; nothing is repeated here.
"""

from __future__ import annotations

import tomllib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import lru_cache
from typing import Literal

import numpy as np

from nao_sim.resources import resource
from nao_sim.robot.errors import UnknownNameError

Limits = Literal["thesis", "v5", "envelope"]
Speed = Literal["nominal", "no_load"]
LIMITS: tuple[str, ...] = ("thesis", "v5", "envelope")

_RPM = 2 * np.pi / 60


@dataclass(frozen=True)
class Motor:
    """A motor at its shaft (table A1-3)."""

    no_load_rpm: float
    stall_mnm: float
    nominal_rpm: float
    nominal_mnm: float
    rotor_inertia_kgm2: float


@dataclass(frozen=True)
class Joint:
    """One row of the joint table.

    Attributes:
        name: NAOqi's name.
        parent, child: the links it connects.
        pos_m, axis: place and axis in the parent's frame; all frames are parallel in the zero pose.
        thesis: range of table A1-1 in NAOqi's sign, rad (hands: open fraction).
        v5: range of the H25 V5.0, rad.
        thesis_sign: -1 where table A1-1 counts the other way round.
        motor, reduction, effort_nm: its motor, the gear ratio, and the torque limit at the joint.
        acceleration: how fast set-points gain speed, rad/s².
        follows: the joint whose motor turns this one too, or None.
    """

    name: str
    parent: str
    child: str
    pos_m: tuple[float, float, float]
    axis: tuple[float, float, float]
    thesis: tuple[float, float]
    v5: tuple[float, float]
    thesis_sign: int
    motor: Motor
    reduction: float
    effort_nm: float
    acceleration: float
    follows: str | None

    @property
    def no_load_speed(self) -> float:
        """Speed without load, rad/s."""
        return self.motor.no_load_rpm * _RPM / self.reduction

    @property
    def nominal_speed(self) -> float:
        """Speed at nominal load, rad/s; the command layer never asks for more."""
        return self.motor.nominal_rpm * _RPM / self.reduction

    @property
    def stall_torque(self) -> float:
        """Torque at rest without the joint's torque limit, ideal gear, Nm."""
        return self.motor.stall_mnm * 1e-3 * self.reduction

    def torque_at(self, speed: float) -> float:
        """Greatest torque in Nm at a speed in rad/s: the datasheet's line, cut at the joint's limit."""
        return min(self.effort_nm, self.stall_torque * (1 - speed / self.no_load_speed))


@dataclass(frozen=True)
class JointTable:
    """Some joints in a fixed order; arrays come back in that order."""

    joints: tuple[Joint, ...]

    @property
    def names(self) -> tuple[str, ...]:
        """The joints' names."""
        return tuple(joint.name for joint in self.joints)

    def index(self, name: str) -> int:
        """Return the row of a joint; raises :class:`UnknownNameError`."""
        try:
            return self.names.index(name)
        except ValueError:
            raise UnknownNameError("joint", name, self.names) from None

    def __getitem__(self, name: str) -> Joint:
        return self.joints[self.index(name)]

    def select(self, names: Iterable[str]) -> JointTable:
        """Return the table of some joints only."""
        return JointTable(tuple(self[name] for name in names))

    def range_rad(self, limits: str = "thesis") -> np.ndarray:
        """Return lower and upper limits, rad (hands: open fraction), ``(n, 2)`` float64.

        ``"thesis"`` is table A1-1 in NAOqi's sign, ``"v5"`` the H25 V5.0, ``"envelope"`` what both allow.
        """
        thesis, v5 = (np.array([getattr(joint, key) for joint in self.joints]) for key in ("thesis", "v5"))
        both = np.stack([np.maximum(thesis[:, 0], v5[:, 0]), np.minimum(thesis[:, 1], v5[:, 1])], axis=1)
        ranges = {"thesis": thesis, "v5": v5, "envelope": both}
        if limits not in ranges:
            raise UnknownNameError("limit set", limits, ranges)
        return ranges[limits]

    def max_speed_rad(self, kind: Speed = "nominal") -> np.ndarray:
        """Return the motors' speed at the joint, rad/s, ``(n,)`` float64."""
        return np.array([j.nominal_speed if kind == "nominal" else j.no_load_speed for j in self.joints])

    def torque_limit_nm(self) -> np.ndarray:
        """Return the torque limit of each joint, Nm, ``(n,)`` float64."""
        return np.array([joint.effort_nm for joint in self.joints])


def _joint(row: dict, motors: dict[str, Motor], controllers: dict[str, dict[str, float]]) -> Joint:
    if "fraction" in row:
        thesis = v5 = tuple(row["fraction"])
    else:
        thesis = tuple(sorted(np.radians(row["thesis_deg"]) * row["thesis_sign"]))
        v5 = tuple(np.radians(row["v5_deg"]))
    return Joint(
        name=row["name"],
        parent=row["parent"],
        child=row["child"],
        pos_m=tuple(row["pos_m"]),
        axis=tuple(row["axis"]),
        thesis=(float(thesis[0]), float(thesis[1])),
        v5=(float(v5[0]), float(v5[1])),
        thesis_sign=row["thesis_sign"],
        motor=motors[row["motor"]],
        reduction=row["reduction"],
        effort_nm=row["effort_nm"],
        acceleration=controllers[str(row["reduction"])]["acceleration_rad_s2"],
        follows=row.get("follows"),
    )


@lru_cache
def joint_table() -> JointTable:
    """Return the whole table, in NAOqi's ``Body`` order."""
    motor_data = tomllib.loads(resource("assets", "nao", "motors.toml").read_text("utf-8"))
    motors = {name: Motor(**motor_data[name]) for name in ("type1", "type2")}
    rows = tomllib.loads(resource("assets", "nao", "joints.toml").read_text("utf-8"))["joint"]
    return JointTable(tuple(_joint(row, motors, motor_data["controller"]) for row in rows))


BODY: tuple[str, ...] = joint_table().names
"""All 26 joints in NAOqi's order."""

ACTUATED: tuple[str, ...] = tuple(joint.name for joint in joint_table().joints if joint.follows is None)
"""The 25 joints with a motor of their own: the order of the actuators and of every ``(25,)`` array."""


def _side(side: str) -> dict[str, tuple[str, ...]]:
    arm = ("ShoulderPitch", "ShoulderRoll", "ElbowYaw", "ElbowRoll", "WristYaw", "Hand")
    leg = ("HipYawPitch", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll")
    return {f"{side}Arm": tuple(side + j for j in arm), f"{side}Leg": tuple(side + j for j in leg)}


CHAINS: dict[str, tuple[str, ...]] = {"Head": ("HeadYaw", "HeadPitch"), **_side("L"), **_side("R")}
CHAINS |= {
    "Arms": CHAINS["LArm"] + CHAINS["RArm"],
    "Legs": CHAINS["LLeg"] + CHAINS["RLeg"],
    "Body": BODY,
    "JointActuators": ACTUATED,
}
"""NAOqi's chains."""


def resolve(names: str | Sequence[str]) -> list[str]:
    """Turn a joint name, a chain name, or a list of them into joint names.

    Raises:
        UnknownNameError: one of them is neither; the message names the nearest.
    """
    wanted = [names] if isinstance(names, str) else list(names)
    resolved: list[str] = []
    for name in wanted:
        if name in CHAINS:
            resolved.extend(CHAINS[name])
        elif name in BODY:
            resolved.append(name)
        else:
            raise UnknownNameError("joint or chain", str(name), (*BODY, *CHAINS))
    return resolved
