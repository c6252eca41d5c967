"""Lines below a child's strip: what was not counted, what the machine did wrong, what a person still has to do."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from nao_sim.game.report.words import listed, seconds, turns_named
from nao_sim.game.study import Trial
from nao_sim.game.tables import Event, Rating
from nao_sim.game.tables.scores import latest_ratings
from nao_sim.game.tables.words import EXCLUSIONS, TECHNICAL


def not_counted(trials: Iterable[Trial]) -> Iterator[str]:
    """Yield the turns that are no trials for reasons of the child or the room, by reason."""
    yield from _excluded(trials, technical=False)


def technical_faults(trials: Sequence[Trial], events: Iterable[Event]) -> Iterator[str]:
    """Yield what went wrong with robot, camera or model; none of it is the child's doing."""
    yield from _excluded(trials, technical=True)
    told = {t.turn.turn_id for t in trials if t.accepted.excluded in TECHNICAL}
    for event in events:
        if event.kind == "fault" and event.turn_id not in told:
            yield f"At {seconds(event.start_s)}: {EXCLUSIONS.get(event.text, event.text) or 'a fault'}"


def _excluded(trials: Iterable[Trial], technical: bool) -> Iterator[str]:
    reasons: dict[tuple[str, str], list[int]] = {}
    for trial in trials:
        reason = trial.accepted.excluded
        if reason is not None and (reason in TECHNICAL) == technical:
            reasons.setdefault((reason, trial.turn.excluded_note), []).append(trial.turn.turn)
    for (reason, note), turns in reasons.items():
        yield f"{turns_named(turns)}: {EXCLUSIONS[reason]}" + (f" ({note})" if note else "")


def still_to_do(trials: Sequence[Trial], ratings: Iterable[Rating]) -> Iterator[str]:
    """Yield what a person still has to look at."""
    scored = [t for t in trials if t.accepted.excluded is None]
    for found, what in (
        ([t for t in scored if t.proposed], "automatic score, not yet confirmed by a person"),
        ([t for t in scored if t.accepted.score is None and not t.accepted.dispute], "not scored by anybody"),
        ([t for t in scored if t.valid and t.turn.prompt_level is None], "no prompt level recorded, so not counted"),
    ):
        if found:
            yield f"{turns_named(t.turn.turn for t in found)}: {what}"
    latest = latest_ratings(ratings)
    for trial in trials:
        if trial.accepted.dispute:
            yield f"Turn {trial.turn.turn}: {trial.accepted.dispute}"
        mine = latest.get(trial.turn.turn_id, {})
        if len({rating.score for rating in mine.values()}) > 1:
            words = [f"{r.rater} says {'no trial' if r.score is None else r.score}" for r in mine.values()]
            yield f"Turn {trial.turn.turn}: {listed(words)}"
