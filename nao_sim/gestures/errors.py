"""Errors of gestures and gesture files."""

from __future__ import annotations

from pathlib import Path

from nao_sim.errors import NaoSimError, did_you_mean


class GestureError(NaoSimError, ValueError):
    """A gesture that cannot be used as asked."""


class UnknownGesture(GestureError, LookupError):
    """No gesture of that name is in the library."""

    def __init__(self, name: str, known: list[str]) -> None:
        self.name = name
        super().__init__(f"no gesture named '{name}'{did_you_mean(name, known)}")


class GestureFileError(GestureError):
    """A gesture file that cannot be read or means nothing; says where and what."""

    def __init__(self, path: str | Path, what: str) -> None:
        self.path = Path(path)
        super().__init__(f"{path}: {what}")
