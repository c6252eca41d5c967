"""What a session file says, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path

from nao_sim.game.session.sources import Camera, Robot, Source, Unseen

HUMANS_WHO_MODEL = ("therapist", "family", "other")


@dataclass(frozen=True)
class Participant:
    """One place in the circle.

    Attributes:
        id: pseudonym.
        role: a word of :data:`nao_sim.game.tables.words.ROLES`.
        turns: where what they do in answer to others comes from, and their own models if ``models`` is None.
        models: where their own models come from, where that differs.
        own_choice: whether nobody knows beforehand which gestures they model.
    """

    id: str
    role: str
    turns: Source
    models: Source | None = None
    own_choice: bool = False

    @property
    def model_source(self) -> Source:
        """Where their own models come from."""
        return self.turns if self.models is None else self.models


@dataclass(frozen=True)
class Orientation:
    """The robot introduced: motionless, then moving (thesis, appendix 4 (1-4-1))."""

    still_s: float = 3.0
    gestures: tuple[str, ...] = ()


@dataclass(frozen=True)
class Prompting:
    """How much help is offered, and how long after the model.

    Attributes:
        highest: 0 to 4, the highest level of :data:`nao_sim.game.tables.words.PROMPT_LEVELS` that is offered.
        praise: whether a related answer is congratulated.
    """

    highest: int = 2
    praise: bool = True


@dataclass(frozen=True)
class Scoring:
    """The written rule of "related".

    Attributes:
        rule: a word of :data:`nao_sim.game.tables.words.RULES`.
        text: the rule in words; required with ``custom``.
        related: with ``custom``: target → gestures that count as related to it.
        scale: ``0/1`` or ``0/1/2``.
        success_at: the lowest score that counts as answered.
    """

    rule: str = "same_class"
    text: str = ""
    related: Mapping[str, tuple[str, ...]] = field(default_factory=dict)
    scale: str = "0/1"
    success_at: int = 1


@dataclass(frozen=True)
class SessionFile:
    """A session as agreed beforehand; see ``docs/game.md`` for every key.

    Attributes:
        path: the file it was read from.
        name: the session's name, unique in a study.
        circle: who sits in the circle, in clockwise order.
        condition, design, assignment, randomised, stratum, number, primary_outcome, margin: as in
            :class:`nao_sim.game.tables.Session`.
        gestures: in play.
        order: ``fixed`` or ``drawn``; ``seed`` None: drawn when the session begins.
        direction: ``clockwise`` or ``counterclockwise``.
        turns: how many turns the game has; None: until ``minutes`` are over, or open.
        minutes: fixed length of the game; None: none.
        baseline: turns without feedback before the game.
        timeout_s: how long an answer is waited for.
        among: what the recogniser decides between; None: all it knows.
        mirror: the robot answers as a mirror would.
        words: what is said, by key of ``assets/game/words.toml``, where it differs from that file.
    """

    path: Path
    name: str
    circle: tuple[Participant, ...]
    condition: str
    design: str
    gestures: tuple[str, ...]
    assignment: str = ""
    randomised: bool = False
    stratum: str | None = None
    number: int | None = None
    primary_outcome: str = "independent"
    margin: float | None = None
    primary_rater: str | None = None
    order: str = "drawn"
    seed: int | None = None
    direction: str = "clockwise"
    turns: int | None = None
    minutes: float | None = None
    baseline: int = 0
    timeout_s: float = 10.0
    among: tuple[str, ...] | None = None
    mirror: bool = False
    orientation: Orientation = Orientation()
    prompting: Prompting = Prompting()
    scoring: Scoring = Scoring()
    words: Mapping[str, str] = field(default_factory=dict)
    note: str = ""

    def participant(self, name: str) -> Participant:
        """Return the participant of that pseudonym."""
        return next(person for person in self.circle if person.id == name)

    @property
    def robot(self) -> Participant | None:
        """The robot, if it takes part."""
        return next((person for person in self.circle if isinstance(person.turns, Robot)), None)

    @property
    def live(self) -> bool:
        """Whether a camera watches, so that time is the clock's."""
        return any(isinstance(source, Camera) for p in self.circle for source in (p.turns, p.model_source))

    @property
    def open_end(self) -> bool:
        """Whether neither a number of turns nor minutes end the game."""
        return self.turns is None and self.minutes is None

    def neighbour(self, person: Participant) -> Participant:
        """Return who imitates that person: the next in the direction of the circle."""
        step = 1 if self.direction == "clockwise" else -1
        return self.circle[(self.circle.index(person) + step) % len(self.circle)]

    def can_be_played(self, model: Participant, imitator: Participant) -> bool:
        """Whether a turn of these two can be played: the answer is seen, and the robot sees what it shall imitate."""
        if isinstance(imitator.turns, Unseen):
            return False
        return not (isinstance(imitator.turns, Robot) and isinstance(model.model_source, Unseen))
