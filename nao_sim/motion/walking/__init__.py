"""Walking: footsteps, preview control, leg kinematics, feedback."""

from nao_sim.motion.walking.controller import Observation, WalkController
from nao_sim.motion.walking.plan import WalkPlan, plan_walk
from nao_sim.motion.walking.walk import observe, walk

__all__ = ["Observation", "WalkController", "WalkPlan", "observe", "plan_walk", "walk"]
