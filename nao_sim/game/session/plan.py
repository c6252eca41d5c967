"""Who models what for whom: the turns of a session in their order."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from nao_sim.game.session.session import HUMANS_WHO_MODEL, Participant, SessionFile
from nao_sim.game.session.sources import Unseen


@dataclass(frozen=True)
class PlannedTurn:
    """One turn as agreed.

    Attributes:
        number: from 1, baseline included.
        phase: ``baseline`` or ``game``.
        model, imitator: pseudonyms.
        target: the gesture to be shown and imitated; None: the model chooses.
    """

    number: int
    phase: str
    model: str
    imitator: str
    target: str | None


def plan_turns(session: SessionFile, seed: int) -> Iterator[PlannedTurn]:
    """Yield the turns of a session; without an agreed number of them they do not end.

    A drawn order is balanced: what one imitator is asked goes through all gestures in play before any comes again.

    Args:
        session: who plays what.
        seed: of a drawn order; ignored by a fixed one.
    """
    decks = {person.id: _deck(session, seed, place) for place, person in enumerate(session.circle)}
    number = itertools.count(1)

    def turn(phase: str, model: Participant, imitator: Participant) -> PlannedTurn:
        target = None if model.own_choice else next(decks[imitator.id])
        return PlannedTurn(next(number), phase, model.id, imitator.id, target)

    children = [person for person in session.circle if person.role == "child"]
    for child in itertools.islice(itertools.cycle(children), session.baseline):
        yield turn("baseline", baseline_model(session), child)
    game = itertools.count() if session.turns is None else range(session.turns)
    pairs = itertools.cycle(_pairs(session))
    for _ in game:
        yield turn("game", *next(pairs))


def _deck(session: SessionFile, seed: int, place: int) -> Iterator[str]:
    """Yield targets for one imitator for ever."""
    rng = np.random.default_rng([seed, place])
    while True:
        if session.order == "fixed":
            yield from session.gestures
        else:
            yield from (session.gestures[k] for k in rng.permutation(len(session.gestures)))


def _pairs(session: SessionFile) -> list[tuple[Participant, Participant]]:
    """One round of the circle, beginning with the robot or else with an adult who models."""
    first = session.robot or baseline_model(session)
    order = [first]
    while (following := session.neighbour(order[-1])) is not first:
        order.append(following)
    pairs = [(person, session.neighbour(person)) for person in order]
    return [pair for pair in pairs if session.can_be_played(*pair)]


def baseline_model(session: SessionFile) -> Participant:
    """Return who models in the baseline: a person if there is one, since no robot takes part yet (thesis, app. 4)."""
    adults = [person for person in session.circle if person.role in HUMANS_WHO_MODEL]
    filmed = [person for person in adults if not isinstance(person.model_source, Unseen)]
    return (filmed or adults or [person for person in session.circle if person.role != "child"])[0]


def child_targets(session: SessionFile, seed: int) -> tuple[str, ...]:
    """Return the targets of the children's turns in planned order, as far as their number is agreed."""
    if session.turns is None:
        return ()
    children = {person.id for person in session.circle if person.role == "child"}
    return tuple(turn.target or "" for turn in plan_turns(session, seed) if turn.imitator in children)
