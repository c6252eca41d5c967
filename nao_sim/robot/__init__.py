"""The NAO: model, joints, motors, sensors, postures, and the class that commands it."""

from nao_sim.robot.errors import (
    AngleRangeError,
    RenderError,
    RobotError,
    SceneError,
    TargetError,
    UnknownNameError,
    UnstableError,
)
from nao_sim.robot.joints import ACTUATED, BODY, CHAINS, LIMITS, Joint, JointTable, joint_table, resolve
from nao_sim.robot.model import model_spec
from nao_sim.robot.nao import CONTROL_PERIOD_S, Nao, step_together
from nao_sim.robot.postures import Posture, posture, postures
from nao_sim.robot.sensors import SensorReadings
from nao_sim.robot.tolerance import SOFTNESS_RAD, on_limits, sets_allowing, tell_apart
from nao_sim.robot.video import Video
from nao_sim.robot.wiring import Wiring, find_robot

__all__ = [
    "ACTUATED",
    "BODY",
    "CHAINS",
    "CONTROL_PERIOD_S",
    "LIMITS",
    "SOFTNESS_RAD",
    "AngleRangeError",
    "Joint",
    "JointTable",
    "Nao",
    "Posture",
    "RenderError",
    "RobotError",
    "SceneError",
    "SensorReadings",
    "TargetError",
    "UnknownNameError",
    "UnstableError",
    "Video",
    "Wiring",
    "find_robot",
    "joint_table",
    "model_spec",
    "on_limits",
    "posture",
    "postures",
    "resolve",
    "sets_allowing",
    "step_together",
    "tell_apart",
]
