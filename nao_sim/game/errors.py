"""The error of the imitation game."""

from nao_sim.errors import NaoSimError


class GameError(NaoSimError):
    """A session, a table of turns or a study that cannot be read, played, scored or reported."""
