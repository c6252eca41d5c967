"""Protocol evidence: order and seed, what was really done, how far raters agree."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.agreement import PairAgreement, Panel, panel_of
from nao_sim.game.report.words import percent
from nao_sim.game.study import StudyResult
from nao_sim.game.study.fidelity import OrderKept, Step, fidelity, order_kept
from nao_sim.game.tables import Tables


@dataclass(frozen=True)
class ProtocolPage:
    """What the template prints.

    Attributes:
        title: of the study.
        orders: each session's order and how far it was kept.
        steps: the protocol's steps.
        share: of all steps due, those done; None where nothing was due.
        panel: the raters.
        pairs: everybody against everybody, the proposal last.
        coverage: how much was scored twice, in words, and whether that is less than a fifth.
    """

    title: str
    orders: tuple[OrderKept, ...]
    steps: tuple[Step, ...]
    share: str
    panel: Panel
    pairs: tuple[PairAgreement, ...]
    coverage: tuple[tuple[str, bool], ...]


def protocol_page(result: StudyResult, title: str, tables: Tables) -> ProtocolPage:
    """Gather a study's evidence."""
    steps = fidelity(result.trials, tables.events)
    due = sum(step.due for step in steps)
    panel = panel_of([t.turn for t in result.trials], tables.ratings, result.sessions[0].scale)
    return ProtocolPage(
        title,
        tuple(order_kept(session, result.trials) for session in result.sessions),
        steps,
        f"{sum(s.done for s in steps)} of {due} ({percent(sum(s.done for s in steps) / due)})" if due else "",
        panel,
        (*panel.people, *panel.proposals),
        tuple(
            (f"{c.condition}, {c.phase}: {c.twice} of {c.trials} turns scored by two people", 5 * c.twice < c.trials)
            for c in panel.coverage
        ),
    )
