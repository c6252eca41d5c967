"""A session on the disk: its journal, its folder, its recording, and the tables made of them."""

from nao_sim.game.store.folder import SessionFolder

__all__ = ["SessionFolder"]
