"""The numbers of the walk, from ``assets/motions/walk.toml``."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache

import numpy as np

from nao_sim.resources import resource


@dataclass(frozen=True)
class Gait:
    """How the robot steps; see ``walk.toml`` for each number. Lengths m, times s, angles rad."""

    step_s: float
    double_support: float
    settle_s: float
    foot_lift_m: float
    lower_m: float
    stance_width_m: float
    most_forward_m: float
    most_sideways_m: float
    most_turn_rad: float
    clearance_m: float
    sole_x_m: tuple[float, float]
    sole_y_m: tuple[float, float]
    zmp_inset_m: float
    arm_swing_rad_m: float


@dataclass(frozen=True)
class Preview:
    """Weights and horizon of the preview controller."""

    horizon_s: float
    zmp_error: float
    state_change: float
    jerk: float


@dataclass(frozen=True)
class Gains:
    """Gains of the feedback from the inertial unit."""

    ankle_pitch: float
    ankle_pitch_rate: float
    ankle_roll: float
    ankle_roll_rate: float


@dataclass(frozen=True)
class WalkSettings:
    """Everything in the file."""

    gait: Gait
    preview: Preview
    gains: Gains


@cache
def walk_settings() -> WalkSettings:
    """Return the settings of the package."""
    data = tomllib.loads(resource("assets", "motions", "walk.toml").read_text("utf-8"))
    # Degrees stay in the file; every *_deg and *_deg_m becomes *_rad and *_rad_m.
    gait = {k.replace("_deg", "_rad"): np.radians(v) if "_deg" in k else v for k, v in data["gait"].items()}
    gait |= {k: tuple(v) for k, v in gait.items() if isinstance(v, list)}
    return WalkSettings(Gait(**gait), Preview(**data["preview"]), Gains(**data["feedback"]))
