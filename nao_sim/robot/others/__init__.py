"""Other people's models of the NAO: read as far as they go, with what was found in them."""

from nao_sim.robot.others.found import Found, look
from nao_sim.robot.others.names import read_names

__all__ = ["Found", "look", "read_names"]
