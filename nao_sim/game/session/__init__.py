"""The session file: who plays what with whom, where each one's turns come from, and how it is scored."""

from nao_sim.game.session.plan import PlannedTurn, child_targets, plan_turns
from nao_sim.game.session.reading import read_session
from nao_sim.game.session.session import Participant, SessionFile
from nao_sim.game.session.sources import Actor, Camera, Cut, Films, LongFilm, Robot, Source, Try, Unseen

__all__ = [
    "Actor",
    "Camera",
    "Cut",
    "Films",
    "LongFilm",
    "Participant",
    "PlannedTurn",
    "Robot",
    "SessionFile",
    "Source",
    "Try",
    "Unseen",
    "child_targets",
    "plan_turns",
    "read_session",
]
