"""Trajectories, whole-body kinematics, balance, walking, getting up."""

from nao_sim.motion.errors import MotionError, RangeExceeded, SpeedExceeded
from nao_sim.motion.limits import Change, check, fit
from nao_sim.motion.perform import MotionLog, perform
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory, joined

__all__ = [
    "CONTROL_PERIOD",
    "Change",
    "MotionError",
    "MotionLog",
    "RangeExceeded",
    "SpeedExceeded",
    "Trajectory",
    "check",
    "fit",
    "joined",
    "perform",
]
