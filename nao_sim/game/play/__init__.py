"""Playing a session: phases, turns, and a folder that survives a kill at any moment."""

from nao_sim.game.play.folder import SessionFolder
from nao_sim.game.play.game import play
from nao_sim.game.play.voice import Say

__all__ = ["Say", "SessionFolder", "play"]
