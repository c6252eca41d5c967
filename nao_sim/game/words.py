"""What is said in a game: ``assets/game/words.toml``, which a session file may put into its own language."""

from __future__ import annotations

import tomllib
from functools import cache

from nao_sim.resources import resource


@cache
def words_table() -> dict[str, str]:
    """Return the default sentences by their key."""
    return tomllib.loads(resource("assets", "game", "words.toml").read_text(encoding="utf-8"))
