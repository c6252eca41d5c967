"""Whether a session file can be played: the parts that must fit each other."""

from __future__ import annotations

import math
from collections import Counter

from nao_sim.errors import did_you_mean
from nao_sim.game.session.keys import Keys
from nao_sim.game.session.plan import plan_turns
from nao_sim.game.session.session import HUMANS_WHO_MODEL, SessionFile
from nao_sim.game.session.sources import Actor, Films, Source
from nao_sim.gestures import library, vocabulary


def check_possible(session: SessionFile, top: Keys, study: Keys, game: Keys) -> None:
    """Refuse what cannot be played, before anything is.

    Args:
        session: as read.
        top, study, game: tables of the file, for messages.

    Raises:
        GameError: one line with the key and the mend.
    """
    from nao_sim.game.session.reading import playable

    if not session.gestures:
        raise game.error("gestures", "is empty; name at least one gesture")
    playable(session.gestures, game, "gestures")
    if session.among is not None:
        playable((name for name in session.among if name not in library()), game, "among")
    _check_circle(session, top, study)
    if session.turns is not None and session.minutes is not None:
        raise game.error("minutes", "stands beside turns; leave one out, or both for an open end")
    if session.turns == 0 and session.baseline == 0:
        raise game.error("turns", "is 0 and there is no baseline; nothing would be played")
    if session.open_end and not session.live and not any(_films(s) for s in _sources(session)):
        raise game.error("turns", "and minutes are missing and nobody's films end the game; write turns or minutes")
    _check_shown(session, game)
    if not any(session.can_be_played(p, session.neighbour(p)) for p in session.circle):
        raise top.error("participant", "leaves no turn that anybody sees; film one who imitates")
    _check_films(session, top)


def _check_circle(session: SessionFile, top: Keys, study: Keys) -> None:
    twice = [name for name, count in Counter(p.id for p in session.circle).items() if count > 1]
    if twice:
        raise top.error("participant", f"has two of the pseudonym '{twice[0]}'; give each their own")
    roles = Counter(person.role for person in session.circle)
    if not roles["child"]:
        raise top.error("participant", 'has no child; add a [[participant]] with role = "child"')
    if roles["robot"] > 1:
        raise top.error("participant", "has two robots; one is simulated")
    adults = sum(roles[role] for role in HUMANS_WHO_MODEL)
    if session.condition == "triadic" and not (roles["robot"] and adults):
        missing = "therapist" if roles["robot"] else "robot"
        raise study.error("condition", f"is triadic (child, therapist, robot) without a {missing}; add one")
    if session.condition == "dyadic" and (roles["robot"] or not adults):
        mend = 'take the robot out or write "triadic"' if roles["robot"] else "add the therapist"
        raise study.error("condition", f"is dyadic (child and therapist, no robot); {mend}")


def _sources(session: SessionFile) -> list[Source]:
    return [source for p in session.circle for source in (p.turns, p.model_source)]


def _films(source: Source) -> bool:
    return isinstance(source, Films)


def _check_shown(session: SessionFile, game: Keys) -> None:
    """An actor shows moving gestures only, and the robot what is in its library."""
    filmable = {name for name, entry in vocabulary().items() if entry.family in ("small", "large")}
    for person in session.circle:
        if any(isinstance(source, Actor) for source in (person.turns, person.model_source)):
            still = next((g for g in session.gestures if g not in filmable), None)
            if still is not None:
                raise game.error(
                    "gestures", f"names '{still}', which the actor {person.id} cannot show on video; take it out"
                )
    if session.robot is not None:
        unknown = next((g for g in session.gestures if g not in library()), None)
        if unknown is not None:
            raise game.error("gestures", f"names '{unknown}', which the robot lacks{did_you_mean(unknown, library())}")


def films_needed(session: SessionFile) -> Counter[tuple[str, str]]:
    """Count the films that the agreed number of turns needs, by pseudonym and key (``turns`` or ``models``)."""
    needed: Counter[tuple[str, str]] = Counter()
    if session.turns is not None:
        for turn in plan_turns(session, seed=0):
            for person, key in ((turn.model, "models"), (turn.imitator, "turns")):
                needed[person, key if session.participant(person).models is not None else "turns"] += 1
    return needed


def _check_films(session: SessionFile, top: Keys) -> None:
    needed = films_needed(session)
    for person in session.circle:
        for key, source in (("turns", person.turns), ("models", person.models)):
            short = _short(source, needed[person.id, key])
            if short is not None:
                raise top.error(f"participant {person.id}.{key}", too_few(session, *short))


def _short(source: Source | None, needed: int) -> tuple[int, int] | None:
    """Return how many turns are on film and how many are needed, where that is too few."""
    given = len(source.turns) if isinstance(source, Films) else math.inf
    return (int(given), needed) if given < needed else None


def too_few(session: SessionFile, given: int, needed: int) -> str:
    """Say that there are fewer turns on film than agreed, and what to do about it."""
    agreed = f"{session.baseline} baseline and {session.turns} game turns"
    return (
        f'has {given} turns on film where {agreed} need {needed}; add films ("none" where nobody moved) or play fewer'
    )
