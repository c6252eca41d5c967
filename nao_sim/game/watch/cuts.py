"""Pieces of films."""

from __future__ import annotations

from nao_sim.game.session import Cut
from recognizer import Clip, open_clip


def open_cut(cut: Cut) -> Clip:
    """Open a piece of a film.

    Raises:
        ClipError: the film cannot be read, or ends before the piece begins.
    """
    whole = open_clip(cut.film)
    if cut.from_s is None and cut.to_s is None:
        return whole
    first = round((cut.from_s or 0.0) * whole.fps)
    last = None if cut.to_s is None else max(first, round(cut.to_s * whole.fps) - 1)
    return open_clip(cut.film, (first, last))
