"""Procedural fidelity: the share of the protocol's steps that were really done, worked out from the recorded times."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from itertools import pairwise

from nao_sim.game.study.trials import Trial
from nao_sim.game.tables import Event, Session

_EARLY_S = 0.1
"""A wait may end so much before its time-out: clocks, frames."""


@dataclass(frozen=True)
class Step:
    """A step of the protocol.

    Attributes:
        name: in words.
        done, due: in how many turns it was done, of those that called for it.
        missed: the keys of the turns that lack it.
    """

    name: str
    done: int
    due: int
    missed: tuple[str, ...]


def fidelity(trials: Sequence[Trial], events: Iterable[Event]) -> tuple[Step, ...]:
    """Check the protocol's steps in every trial that was not excluded; steps that no turn called for are left out."""
    prompts: dict[str, list[Event]] = {}
    for event in sorted(events, key=lambda e: e.start_s):
        if event.kind == "prompt" and event.turn_id is not None:
            prompts.setdefault(event.turn_id, []).append(event)
    played = [trial for trial in trials if trial.accepted.excluded is None]
    ask: list[tuple[str, Callable[[Trial], bool | None]]] = [
        ("the instruction was given", lambda t: t.turn.instruction_s is not None),
        ("the model was shown to its end", lambda t: t.turn.model_end_s is not None),
        ("the time-out was waited for", _waited),
        ("prompts went from least to most help", lambda t: _rising(prompts.get(t.turn.turn_id, []))),
        ("a success in the game was praised", _praised),
        ("nothing was praised in the baseline", _unpraised),
    ]
    steps = []
    for name, was_done in ask:
        answers = [(trial.turn.turn_id, was_done(trial)) for trial in played]
        due = [(key, done) for key, done in answers if done is not None]
        if due:
            missed = tuple(key for key, done in due if not done)
            steps.append(Step(name, len(due) - len(missed), len(due), missed))
    return tuple(steps)


def _waited(trial: Trial) -> bool | None:
    timeout, waited = trial.session.timeout_s, trial.turn.waited_s
    return (
        None if timeout is None or not trial.turn.latency_censored or waited is None else waited >= timeout - _EARLY_S
    )


def _rising(prompts: Sequence[Event]) -> bool | None:
    levels = [event.level for event in prompts if event.level is not None]
    return all(a <= b for a, b in pairwise(levels)) if levels else None


def _praised(trial: Trial) -> bool | None:
    return trial.turn.praise_s is not None if trial.turn.phase == "game" and trial.success else None


def _unpraised(trial: Trial) -> bool | None:
    return trial.turn.praise_s is None if trial.turn.phase == "baseline" else None


@dataclass(frozen=True)
class OrderKept:
    """The order of a session's targets: as listed or drawn, with its seed, and how far it was kept.

    Attributes:
        session: which.
        order, seed: how it came about.
        planned, played: how many child's turns were planned and played.
        kept: how many of the played ones had the target planned at their place; None without a plan.
    """

    session: str
    order: str
    seed: int | None
    planned: int
    played: int
    kept: int | None


def order_kept(session: Session, trials: Iterable[Trial]) -> OrderKept:
    """Compare the targets of the game's child's turns with the plan, place by place."""
    targets = [t.turn.target for t in trials if t.turn.session == session.session and t.turn.phase == "game"]
    kept = sum(a == b for a, b in zip(targets, session.planned, strict=False)) if session.planned else None
    return OrderKept(session.session, session.order, session.seed, len(session.planned), len(targets), kept)
