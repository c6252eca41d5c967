"""The study page: children as the unit, three verdicts, pictures where that is all there can be."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass
from fractions import Fraction

from markupsafe import Markup

from nao_sim.game.report.dots import dots_figure
from nao_sim.game.report.words import listed, percent, points, seconds, signed
from nao_sim.game.statistics import ALPHA, MixedModel, wilson_interval
from nao_sim.game.study import ChildResult, StudyResult, child_results
from nao_sim.game.study.result import mean
from nao_sim.game.tables.words import CONDITIONS, EXCLUSIONS, OUTCOMES


@dataclass(frozen=True)
class ChildRow:
    """One child's line of the table."""

    child: str
    condition: str
    outcome: str
    share: str
    interval: str
    baseline: str
    latency: str
    excluded: str
    proposed: int


@dataclass(frozen=True)
class StudyPage:
    """What the template prints."""

    title: str
    outcome: str
    settings: tuple[str, ...]
    provisional: str
    obstacles: tuple[str, ...]
    left_out: tuple[str, ...]
    children: tuple[ChildRow, ...]
    figure: Markup | None
    results: tuple[tuple[str, str], ...]
    verdicts: tuple[str, ...]
    others: tuple[tuple[str, str, str], ...]


def study_page(result: StudyResult) -> StudyPage:
    """Put a study's result into words."""
    first = result.sessions[0]
    proposed = sum(c.proposed for c in result.children)
    valid = sum(c.valid for c in result.children)
    return StudyPage(
        title=_title(result),
        outcome=f"{result.outcome.replace('_', ' ')}: {OUTCOMES[result.outcome]}",
        settings=(
            f"Scores {first.scale}, a success from {first.success_at}; a score means: {first.rule_text or first.rule}",
            f"Assignment: {first.assignment or 'not stated'}"
            + (" (drawn at random)" if first.randomised else " (not drawn at random)"),
            f"{len(result.sessions)} sessions, {len({c.child for c in result.children})} children in the game",
        ),
        provisional=f"{proposed} of {valid} scores are automatic proposals that no person has confirmed"
        * bool(proposed),
        obstacles=result.obstacles,
        left_out=result.left_out,
        children=_rows(result),
        figure=dots_figure(result),
        results=tuple(_results(result)) if result.design != "single_case" else (),
        verdicts=result.verdicts.sentences if result.verdicts else (),
        others=_others(result),
    )


def _title(result: StudyResult) -> str:
    design = {"groups": "Two groups", "crossover": "Crossover", "single_case": "Single cases"}[result.design]
    return f"{design}: {result.study}" if result.study else design


def _rows(result: StudyResult) -> tuple[ChildRow, ...]:
    before = {(b.child, b.condition): b for b in result.baseline}
    rows = []
    for c in sorted(result.children, key=lambda c: (CONDITIONS.index(c.condition), c.child)):
        baseline = before.get((c.child, c.condition))
        rows.append(
            ChildRow(
                c.child,
                c.condition,
                _count(c),
                percent(c.share),
                _interval(c, result.outcome),
                "–" if baseline is None else f"{_count(baseline)} ({percent(baseline.share)})",
                _latency(c),
                _excluded(c),
                c.proposed,
            )
        )
    return tuple(rows)


def _count(c: ChildResult) -> str:
    total = c.total if c.total.denominator == 1 else round(float(c.total), 1)
    return f"{total} of {c.counted}"


def _interval(c: ChildResult, outcome: str) -> str:
    if outcome == "mean_score" or not c.counted:
        return "–"
    low, high = wilson_interval(int(c.total), c.counted)
    return f"{100 * low:.0f} to {100 * high:.0f} %"


def _latency(c: ChildResult) -> str:
    found = c.latency
    if not found.answered:
        return f"none; {found.censored} without movement" if found.censored else "–"
    span = f" ({seconds(found.shortest_s)} to {seconds(found.longest_s)})"
    median = "over half without movement" if found.median_s is None else seconds(found.median_s)
    return median + span + (f"; {found.censored} without movement" if found.censored else "")


def _excluded(c: ChildResult) -> str:
    parts = [f"{n} × {EXCLUSIONS[reason]}" for reason, n in c.excluded.items()]
    parts += [f"{c.unscored} not scored"] * bool(c.unscored) + [f"{c.unprompted} without prompt level"] * bool(
        c.unprompted
    )
    return "; ".join(parts) or "none"


def _results(result: StudyResult) -> list[tuple[str, str]]:
    a, b = CONDITIONS
    means = {c: result.mean(c) for c in CONDITIONS}
    lines = [
        ("Children", listed(f"{len(result.of(c))} {c}" for c in CONDITIONS)),
        ("Mean of the children, unweighted", listed(f"{c} {percent(means[c])}" for c in CONDITIONS)),
    ]
    found = result.comparison
    lines.append(("Excluded turns", _all_excluded(result)))
    baselines = [result.mean(c, "baseline") for c in CONDITIONS]
    if baselines[0] is not None and baselines[1] is not None:
        lines.append(("Baseline", f"{a} {percent(baselines[0])}, {b} {percent(baselines[1])}; described, not tested"))
    if found is None:
        return lines
    kind = "children exchanged between groups" if result.design == "groups" else "signs of the children's differences"
    how = f"all {found.ways:,} ways counted" if found.exact else f"a seeded sample of {found.ways - 1:,} ways"
    interval = (
        f"{points(found.interval[0])} to {points(found.interval[1])} percentage points"
        if found.interval
        else f"none: with so few children no difference is ever rejected at {100 * ALPHA:.0f} %"
    )
    lines += [
        (f"Difference, {a} less {b}", f"{points(found.difference)} percentage points"),
        (f"{100 * (1 - ALPHA):.0f} % interval, by inversion of the test", interval),
        ("Exact permutation, two-sided", f"p = {found.extreme:,}/{found.ways:,} = {found.p:.4f} ({kind}; {how})"),
        ("Smallest p this design can reach", f"{found.smallest:,}/{found.ways:,} = {found.smallest_p:.4f}"),
    ]
    if result.design == "groups":
        lines.append(("Sensitivity: logistic mixed model, t(children − 2)", _model(result.model)))
    return lines


def _model(model: MixedModel | str) -> str:
    if isinstance(model, str):
        return f"none, {model}"
    low, high = model.interval
    return (
        f"log odds ratio {signed(model.log_odds_ratio)} (95 % {signed(low)} to {signed(high)}), t({model.freedom}), "
        f"p = {model.p:.3f}; spread of the children {model.child_sd:.2f} logits"
    )


def _all_excluded(result: StudyResult) -> str:
    reasons: Counter[str] = Counter()
    for c in result.children:
        reasons.update(c.excluded)
    named = listed(f"{n} × {EXCLUSIONS[reason]}" for reason, n in reasons.items())
    return f"{reasons.total()} of {sum(c.turns for c in result.children)}" + (f": {named}" if named else "")


def _others(result: StudyResult) -> tuple[tuple[str, str, str], ...]:
    """Describe the outcomes that are not the primary one; none of them is tested."""
    rows = []
    for name in OUTCOMES:
        if name != result.outcome:
            results = [r for r in child_results(result.trials, name) if r.phase == "game"]
            shares = {c: _mean_of(results, c) for c in CONDITIONS}
            rows.append((OUTCOMES[name], percent(shares[CONDITIONS[0]]), percent(shares[CONDITIONS[1]])))
    return tuple(rows)


def _mean_of(results: list[ChildResult], condition: str) -> Fraction | None:
    return mean([r.share for r in results if r.condition == condition and r.share is not None])
