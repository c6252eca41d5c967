"""Playing a session: phases, turns, and everybody who takes part."""

from nao_sim.game.play.game import play
from nao_sim.game.play.voice import Say

__all__ = ["Say", "play"]
