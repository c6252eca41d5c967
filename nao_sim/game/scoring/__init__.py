"""Scores: the automatic proposal by a written rule, and what people say beside it."""

from nao_sim.game.scoring.related import Proposal, propose, side_of

__all__ = ["Proposal", "propose", "side_of"]
