"""The strip of a child's turns in the order played; each cell says in words what happened."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path

from nao_sim.game.report.links import film_link
from nao_sim.game.report.words import gesture_words, seconds
from nao_sim.game.study import Trial
from nao_sim.game.tables.words import EXCLUSIONS, PROMPT_LEVELS


@dataclass(frozen=True)
class StripCell:
    """One turn: its number, gesture, mark (a style's name), what happened, latency, and where the film shows it."""

    turn: int
    gesture: str
    mark: str
    says: str
    latency: str
    confirmed: bool
    link: str | None


def strip_cells(trials: Iterable[Trial], folder: Path, report: Path) -> tuple[StripCell, ...]:
    """Return the cells of some trials of one session."""
    return tuple(_cell(trial, folder, report) for trial in trials)


def _cell(trial: Trial, folder: Path, report: Path) -> StripCell:
    turn, accepted = trial.turn, trial.accepted
    if accepted.excluded is not None:
        mark, says = "excluded", f"no trial: {EXCLUSIONS[accepted.excluded]}"
    elif accepted.score is None:
        mark, says = "unscored", "not scored yet"
    elif trial.success:
        helped = PROMPT_LEVELS.get(turn.prompt_level, "help not recorded") if turn.prompt_level is not None else None
        mark = "independent" if trial.independent else "helped"
        says = helped or "help not recorded"
    else:
        mark = "missed"
        says = "not answered" if turn.prompt_level in (None, 0) else f"not answered, {PROMPT_LEVELS[turn.prompt_level]}"
    if trial.valid and trial.session.scale != "0/1":
        says += f" ({accepted.score})"
    wait = f"none in {seconds(turn.waited_s)}" if turn.latency_censored else ""
    return StripCell(
        turn.turn,
        gesture_words(turn.target),
        mark,
        says,
        wait or ("" if turn.latency_s is None else seconds(turn.latency_s)),
        not trial.proposed,
        film_link(report, folder, turn.film or trial.session.film, turn.film_s),
    )
