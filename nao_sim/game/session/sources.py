"""Where a participant's turns come from."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path


@dataclass(frozen=True)
class Cut:
    """A piece of a film: from … to in seconds, None for its start and its end."""

    film: Path
    from_s: float | None = None
    to_s: float | None = None


@dataclass(frozen=True)
class Try:
    """One attempt that was filmed.

    Attributes:
        cut: the film of it; None: nobody moved within the time-out, and nothing was filmed.
        prompt: help given before it, 0 to 4.
        excluded: why it is no trial, a word of :data:`nao_sim.game.tables.words.EXCLUSIONS`; None: it is one.
    """

    cut: Cut | None
    prompt: int = 0
    excluded: str | None = None


@dataclass(frozen=True)
class Films:
    """A video a turn: for each turn its tries, in order.

    Attributes:
        turns: the tries of each turn.
        starts_at_model_end: whether each film begins when the model has ended, so that a latency can be read from it.
    """

    turns: tuple[tuple[Try, ...], ...]
    starts_at_model_end: bool = False


@dataclass(frozen=True)
class LongFilm:
    """One long video, of which every stretch of motion is a turn; with cuts it is read as :class:`Films` instead."""

    film: Path
    starts_at_model_end: bool = False


@dataclass(frozen=True)
class Camera:
    """A camera stream: a device's number, or anything that FFmpeg opens (a device file, an address)."""

    device: int | str


@dataclass(frozen=True)
class Actor:
    """A simulated person of ``models/person``, filmed by a camera that stands still.

    Attributes:
        seed: draws the person, the room and every performance.
        child: whether the person is a child.
        follows: probability of doing what is asked without help.
        helped: the same after each prompt.
        unrelated: share of failures in which something else is done; in the others nobody moves.
        mirrors: probability of using the other side of the body where the gesture has one.
    """

    seed: int
    child: bool = True
    follows: float = 0.7
    helped: float = 0.5
    unrelated: float = 0.5
    mirrors: float = 0.25


@dataclass(frozen=True)
class Robot:
    """The simulated NAO itself."""


@dataclass(frozen=True)
class Unseen:
    """In the circle, but on no film: only what others answer to this person can be known."""


Source = Films | LongFilm | Camera | Actor | Robot | Unseen
