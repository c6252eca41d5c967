"""What the people in the circle do: from films, from a camera, or acted."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import ExitStack
from dataclasses import dataclass
from typing import Protocol

from nao_sim.game.errors import GameError
from nao_sim.game.play.actor import ActorPlayer, new_stage
from nao_sim.game.play.camera import CameraPlayer
from nao_sim.game.session import Actor, Camera, Cut, Films, LongFilm, Participant, PlannedTurn, SessionFile, Source, Try
from nao_sim.game.session.possible import films_needed, too_few
from nao_sim.game.watch.cuts import open_cut
from nao_sim.game.watch.watching import Film
from nao_sim.people.filming.stage import Stage
from recognizer import Recognizer

Progress = Callable[[str, int, int | None], None]


@dataclass(frozen=True)
class Attempt:
    """One attempt of one person.

    Attributes:
        film: what can be watched; None: nobody moved, and nothing was filmed.
        prompt: help that was given before it, where the session file says so; None: the game decides.
        excluded: why it is no trial, where the session file says so.
        cut: the own film that it is a piece of; None: it must be kept with the session.
        starts_at_model_end: whether the film begins when the model has ended.
    """

    film: Film | None
    prompt: int | None = None
    excluded: str | None = None
    cut: Cut | None = None
    starts_at_model_end: bool = True


class Player(Protocol):
    """One person's turns."""

    def begin(self) -> None:
        """Go on to the next performance, also to one that was played before the session was resumed."""

    def attempt(self, turn: PlannedTurn, number: int, answering: bool) -> Attempt | None:
        """Return an attempt, counted from 0; None: there is no further one."""


class FilmPlayer:
    """Somebody whose turns are on films.

    Args:
        films: the tries of each turn.
    """

    def __init__(self, films: Films) -> None:
        self._films = films
        self._at = -1

    def begin(self) -> None:
        """Take the next film; see :class:`Player`."""
        self._at += 1

    @property
    def over(self) -> bool:
        """Whether the film that would be next is not there."""
        return self._at + 1 >= len(self._films.turns)

    def attempt(self, turn: PlannedTurn, number: int, answering: bool) -> Attempt | None:
        """Open the film of an attempt; see :class:`Player`."""
        tries = self._films.turns[self._at]
        if number >= len(tries):
            return None
        one: Try = tries[number]
        film = None if one.cut is None else Film.of(open_cut(one.cut))
        return Attempt(film, one.prompt, one.excluded, one.cut, self._films.starts_at_model_end)


@dataclass
class ActedPlayer:
    """Somebody simulated."""

    actor: ActorPlayer
    stage: Callable[[], Stage]

    def begin(self) -> None:
        """Nothing to do: what is acted follows from the turn."""

    def attempt(self, turn: PlannedTurn, number: int, answering: bool) -> Attempt | None:
        """Act and film one attempt; see :class:`Player`."""
        from nao_sim.game.play.actor import FPS, filmed

        if turn.target is None:
            raise GameError("an actor cannot choose its gesture; take own_choice away")
        deed = self.actor.answer(turn.number, number, turn.target) if answering else filmed(turn.target)
        frames = self.actor.film(self.stage(), deed, turn.number, number, answering)
        return Attempt(Film(frames, FPS, f"{'answer' if answering else 'model'} of turn {turn.number}"))


def players_of(
    session: SessionFile, recognizer: Recognizer, stack: ExitStack, progress: Progress | None = None
) -> dict[tuple[str, bool], Player]:
    """Return who shows what: by pseudonym, and whether they answer (or model).

    Args:
        session: what was agreed; participants without films, camera or actor have no player.
        recognizer: finds the turns of a long film.
        stack: closes cameras and the stage.
        progress: see :func:`nao_sim.game.play.play`.

    Raises:
        GameError: a camera or a long film that cannot be used.
    """
    stages: list[Stage] = []

    def stage() -> Stage:
        if not stages:
            stages.append(stack.enter_context(new_stage()))
        return stages[0]

    needed = films_needed(session)

    def player(person: Participant, place: int, source: Source, key: str) -> Player | None:
        if isinstance(source, LongFilm):
            source = _stretches(person.id, source, recognizer, progress)
            if len(source.turns) < needed[person.id, key]:
                what = too_few(session, len(source.turns), needed[person.id, key])
                raise GameError(f"participant {person.id}.{key} {what}")
        if isinstance(source, Films):
            return FilmPlayer(source)
        if isinstance(source, Actor):
            return ActedPlayer(ActorPlayer(source, place), stage)
        if isinstance(source, Camera):
            return stack.enter_context(CameraPlayer(person.id, source, session.timeout_s))
        return None

    found: dict[tuple[str, bool], Player] = {}
    for place, person in enumerate(session.circle):
        answers = player(person, place, person.turns, "turns")
        models = answers if person.models is None else player(person, place, person.models, "models")
        found |= {(person.id, True): answers} if answers is not None else {}
        found |= {(person.id, False): models} if models is not None else {}
    return found


def _stretches(who: str, source: LongFilm, recognizer: Recognizer, progress: Progress | None) -> Films:
    """Return every stretch of motion of a long film as a turn."""

    def show(done: int, total: int | None) -> None:
        if progress is not None:
            progress(f"Finding the turns of {who}", done, total)

    found = recognizer.recognize_all(source.film, None, show)
    turns = tuple((Try(Cut(source.film, r.start, r.end)),) for r in found)
    if not turns:
        raise GameError(f"{source.film}: nobody moves in it; write the turns of {who} down as cuts")
    return Films(turns, source.starts_at_model_end)
