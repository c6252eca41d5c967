"""The vocabulary: which gestures there are and what they mean (``assets/vocabulary.toml``)."""

from __future__ import annotations

import tomllib
from dataclasses import dataclass
from functools import cache

from nao_sim.resources import resource

FAMILIES = ("static", "small", "large", "game", "own")
KINDS = ("posture", "cyclic", "linear")
CLASSES = ("symbolic", "interactional", "pointing", "none")


@dataclass(frozen=True)
class Entry:
    """One gesture of the vocabulary (thesis, chapters 1 and 2 and appendix 2); fields as in the file's header."""

    name: str
    number: int | None
    family: str
    kind: str
    communicative_class: str
    playable: bool
    mirror: str
    title: str


@cache
def vocabulary() -> dict[str, Entry]:
    """Return the 22 gestures by name, in the file's order: static, small, large, each by its number."""
    rows = tomllib.loads(resource("assets", "vocabulary.toml").read_text(encoding="utf-8"))["gesture"]
    return {
        row["name"]: Entry(
            row["name"],
            row["number"],
            row["family"],
            row["kind"],
            row["class"],
            row["playable"],
            row["mirror"],
            row["title"],
        )
        for row in rows
    }
