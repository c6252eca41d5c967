"""Getting up after a fall."""

from nao_sim.motion.getting_up.get_up import get_up, stands
from nao_sim.motion.getting_up.key_frames import get_up_trajectory
from nao_sim.motion.getting_up.lying import Lie, lie_of

__all__ = ["Lie", "get_up", "get_up_trajectory", "lie_of", "stands"]
