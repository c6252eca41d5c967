"""Made-up studies with a seed: tables as a game writes them, for trying reports, statistics and exports.

Nobody played these sessions; their ``note`` says so.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from datetime import datetime, timedelta, timezone
from typing import Any

import numpy as np

from nao_sim.game.tables import Event, Rating, Session, Tables, Turn

GESTURES = ("bye_right", "stop", "yes", "no", "right_arm_up", "bye_two_hands")
NOTE = "made up, nobody played this"
_CIRCLES = {
    "triadic": ("robot:NAO", "therapist:T1", "child:{}"),
    "dyadic": ("therapist:T1", "child:{}"),
}
_SIDED = ("bye_right", "stop", "right_arm_up")


@dataclass(frozen=True)
class Recipe:
    """How a study is made up.

    Attributes:
        design: ``groups``, ``crossover`` or ``single_case``.
        children: per condition; in crossover and single case in all.
        sessions: of each child and condition; single case: in all, the first ones baseline.
        turns: of the child in a session's game (and half as many in its baseline).
        skill: chance of an independent answer of the average child, on the logit scale.
        effect: what the triadic condition, or the game phase of a single case, adds on that scale.
        child_sd: spread of the children on that scale.
        agreement: chance that a second rater gives the first rater's score.
        rated: share of turns that a person has confirmed.
        scale: of the scores.
        margin: of equivalence, fixed beforehand.
        study: its name.
    """

    design: str = "groups"
    children: int = 4
    sessions: int = 2
    turns: int = 10
    skill: float = -0.3
    effect: float = 1.0
    child_sd: float = 1.0
    agreement: float = 0.9
    rated: float = 1.0
    scale: str = "0/1"
    margin: float | None = 0.2
    study: str = ""


@dataclass
class _Sheets:
    sessions: list[Session] = field(default_factory=list)
    turns: list[Turn] = field(default_factory=list)
    ratings: list[Rating] = field(default_factory=list)
    events: list[Event] = field(default_factory=list)


def make_up(recipe: Recipe, seed: int) -> Tables:
    """Return a study's tables; the same recipe and seed give the same tables."""
    rng = np.random.default_rng(seed)
    sheets = _Sheets()
    number = 0
    for child, conditions in _children(recipe):
        ability = recipe.skill + recipe.child_sd * rng.standard_normal()
        plan = [c for c in conditions for _ in range(recipe.sessions)]
        baselines = 3 + int(child[1:]) % 3 if recipe.design == "single_case" else 0
        for sitting, condition in enumerate(plan):
            number += 1
            only_baseline = sitting < baselines
            session = _session(recipe, f"S{number:02}", child, condition, sitting, rng)
            _play(recipe, session, child, ability, only_baseline, rng, sheets)
    return Tables(tuple(sheets.sessions), tuple(sheets.turns), tuple(sheets.ratings), tuple(sheets.events))


def _children(recipe: Recipe) -> list[tuple[str, tuple[str, ...]]]:
    both = ("triadic", "dyadic")
    if recipe.design == "groups":
        return [(f"C{i + 1:02}", (both[i % 2],)) for i in range(2 * recipe.children)]
    if recipe.design == "crossover":
        return [(f"C{i + 1:02}", both if i % 2 else both[::-1]) for i in range(recipe.children)]
    return [(f"C{i + 1:02}", ("triadic",)) for i in range(recipe.children)]


def _session(recipe: Recipe, name: str, child: str, condition: str, sitting: int, rng: np.random.Generator) -> Session:
    seed = int(rng.integers(1, 10_000))
    planned = tuple(str(g) for g in np.random.default_rng(seed).choice(GESTURES, recipe.turns))
    started = datetime(2027, 3, 1, 10, 0, tzinfo=timezone(timedelta(hours=1))) + timedelta(days=7 * sitting)
    return Session(
        session=name,
        started=(started + timedelta(minutes=45 * (int(child[1:]) - 1))).isoformat(),
        circle=tuple(seat.format(child) for seat in _CIRCLES[condition]),
        condition=condition,
        design=recipe.design,
        study=recipe.study,
        number=sitting + 1,
        assignment="drawn by lot" if recipe.design != "single_case" else "staggered starts of the game, fixed",
        randomised=recipe.design != "single_case",
        order="drawn",
        seed=seed,
        planned=planned,
        timeout_s=8.0,
        margin=recipe.margin,
        scale=recipe.scale,
        rule_text="1 when what was seen is the gesture asked for, on either side of the body",
        primary_rater="R1",
        film="film.mp4",
        note=NOTE,
    )


def _play(
    recipe: Recipe,
    session: Session,
    child: str,
    ability: float,
    only_baseline: bool,
    rng: np.random.Generator,
    sheets: _Sheets,
) -> None:
    now, number = 60.0, 0
    single = recipe.design == "single_case"
    phases = [("baseline", recipe.turns if single else recipe.turns // 2)] if only_baseline or not single else []
    phases += [] if only_baseline else [("game", recipe.turns)]
    sheets.events.append(Event(session.session, "phase", 0.0, end_s=now, label="orientation"))
    for phase, turns in phases:
        begun = now
        helped = (single and phase == "game") or (not single and session.condition == "triadic" and phase == "game")
        for i in range(turns):
            target = session.planned[i % len(session.planned)]
            if "robot:NAO" in session.circle and rng.random() < 0.5:
                number += 1
                sheets.turns.append(_answered_by_robot(session, number, phase, target, now))
                now += 12.0
            number += 1
            turn = _answered_by_child(session, number, phase, target, child, now, ability + helped * recipe.effect, rng)
            _rate(recipe, session, turn, rng, sheets)
            _say(session, turn, child, rng, sheets)
            sheets.turns.append(turn)
            now += 20.0
        sheets.events.append(Event(session.session, "phase", begun, end_s=now, label=phase))
    sheets.events.append(Event(session.session, "phase", now, end_s=now + 30, label="closing"))
    sheets.sessions.append(replace(session, duration_s=now + 30))


def _answered_by_robot(session: Session, number: int, phase: str, target: str, now: float) -> Turn:
    return Turn(
        **_ids(session, number, phase, target),
        model="T1",
        model_role="therapist",
        imitator="NAO",
        imitator_role="robot",
        model_start_s=now,
        model_end_s=now + 2.5,
        movement_start_s=now + 2.7,
        movement_end_s=now + 7.0,
        latency_s=0.2,
        seen=target,
        seen_distance=0.2,
        seen_limit=0.45,
        answer_delay_s=0.2,
        film="film.mp4",
        film_s=now,
    )


def _ids(session: Session, number: int, phase: str, target: str) -> dict[str, Any]:
    return {
        "turn_id": f"{session.session}/{number:03}",
        "session": session.session,
        "turn": number,
        "phase": phase,
        "condition": session.condition,
        "design": session.design,
        "target": target,
    }


def _answered_by_child(
    session: Session,
    number: int,
    phase: str,
    target: str,
    child: str,
    now: float,
    logit: float,
    rng: np.random.Generator,
) -> Turn:
    triadic = session.condition == "triadic"
    start = now + 2.0
    end = start + 3.0
    turn = Turn(
        **_ids(session, number, phase, target),
        model="NAO" if triadic else "T1",
        model_role="robot" if triadic else "therapist",
        imitator=child,
        imitator_role="child",
        instruction_s=now,
        model_start_s=start,
        model_end_s=end,
        film="film.mp4",
        film_s=now,
        auto_rule="same_class",
        auto_scale=session.scale,
    )
    fate = rng.random()
    if fate < 0.04:
        reason = ("child_left", "camera_blind", "robot_fell" if triadic else "model_failed")[int(rng.integers(3))]
        return replace(turn, excluded=reason, auto_rule=None, auto_scale=None)
    independent = rng.random() < 1 / (1 + np.exp(-logit))
    level = 0 if independent or phase == "baseline" else int(rng.integers(1, 4))
    answered = independent or (phase == "game" and rng.random() < 0.6)
    turn = replace(turn, prompt_level=level, prompt_s=round(end + 4.0, 3) if level else None)
    if not answered:
        return replace(turn, latency_censored=True, waited_s=8.0, auto_score=0, seen_reason="nothing moved")
    latency = round(float(rng.lognormal(0.3, 0.4)) + (4.0 if level else 0.0), 3)
    best = int(session.scale.split("/")[-1])
    right = rng.random() < 0.85  # the recogniser errs
    return replace(
        turn,
        latency_s=latency,
        movement_start_s=round(end + latency, 3),
        movement_end_s=round(end + latency + 2.0, 3),
        praise_s=round(end + latency + 2.5, 3) if phase == "game" else None,
        seen=target if right else None,
        seen_distance=round(float(rng.uniform(0.1, 0.4)) + (0 if right else 0.2), 3),
        seen_limit=0.45,
        seen_reason="nearest neighbours agree" if right else "too far from all known gestures",
        side=str(rng.choice(["same", "mirrored"])) if right and target in _SIDED else None,
        auto_score=best if right else 0,
    )


def _rate(recipe: Recipe, session: Session, turn: Turn, rng: np.random.Generator, sheets: _Sheets) -> None:
    if turn.excluded is not None or rng.random() >= recipe.rated:
        return
    top = int(session.scale.split("/")[-1])
    score = 0 if turn.latency_s is None else int(rng.integers(1, top + 1))
    when = (datetime.fromisoformat(session.started) + timedelta(hours=3)).isoformat()
    sheets.ratings.append(Rating(turn.turn_id, "R1", when, score, scale=session.scale))
    if rng.random() < 0.4:
        other = score if rng.random() < recipe.agreement else (score + 1) % (top + 1)
        sheets.ratings.append(Rating(turn.turn_id, "R2", when, other, scale=session.scale, blind=True))


_INITIATIONS: Sequence[str] = ("Noch mal!", "Guck mal, NAO!", "Ich will anfangen")
_ANSWERS: Sequence[str] = ("Ja", "Winken", "Fertig")


def _say(session: Session, turn: Turn, child: str, rng: np.random.Generator, sheets: _Sheets) -> None:
    s, key = session.session, turn.turn_id
    if turn.prompt_level and turn.prompt_s is not None:
        teller = turn.model
        text = "Mach es wie ich!"
        sheets.events.append(
            Event(s, "prompt", turn.prompt_s, who=teller, turn_id=key, level=turn.prompt_level, text=text)
        )
    if turn.praise_s is not None:
        sheets.events.append(Event(s, "praise", turn.praise_s, who=turn.model, turn_id=key, text="Super gemacht!"))
    start = (turn.film_s or 0.0) + 14.0
    for words, label, chance in ((_INITIATIONS, "initiation", 0.15), (_ANSWERS, "answer", 0.3)):
        if rng.random() < chance:
            said = str(rng.choice(list(words)))
            sheets.events.append(Event(s, "speech", start, start + 1.0, child, key, label, text=said))
            start += 1.5
    if turn.excluded in ("robot_fell", "camera_blind", "model_failed"):
        sheets.events.append(Event(s, "fault", turn.film_s or 0.0, turn_id=key, text=str(turn.excluded)))
