"""Where seeing and moving meet: imitation episodes and their storage."""

from nao_sim.episodes.episode import Answer, Episode
from nao_sim.episodes.errors import EpisodeError
from nao_sim.episodes.imitate import imitate
from nao_sim.episodes.outcome import Outcome
from nao_sim.episodes.store import save_episode

__all__ = ["Answer", "Episode", "EpisodeError", "Outcome", "imitate", "save_episode"]
