"""The error of episodes."""

from nao_sim.errors import NaoSimError


class EpisodeError(NaoSimError):
    """An episode that cannot be run or written."""
