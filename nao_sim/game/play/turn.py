"""One turn: somebody models, the neighbour answers, with help where it is needed and praise where it is due."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from nao_sim.episodes.episode import Answer
from nao_sim.episodes.imitate import answer_to
from nao_sim.game.play.clock import Clock
from nao_sim.game.play.people import Attempt, Player
from nao_sim.game.play.robot import RobotPlayer
from nao_sim.game.play.voice import Voice
from nao_sim.game.session import Participant, PlannedTurn, Robot, SessionFile
from nao_sim.game.session.related import propose
from nao_sim.game.store.turn_record import Shown, TurnRecord
from nao_sim.game.tables.words import PROMPT_LEVELS
from nao_sim.game.watch.watching import Watched, Watcher

MODEL_AGAIN = 2


@dataclass(frozen=True)
class Table:
    """Everything and everybody a turn needs.

    Attributes:
        session: what was agreed.
        clock: the session's time.
        voice: speaks.
        watcher: recognises.
        robot: None in a dyadic session.
        players: see :func:`nao_sim.game.play.people.players_of`.
    """

    session: SessionFile
    clock: Clock
    voice: Voice
    watcher: Watcher
    robot: RobotPlayer | None
    players: Mapping[tuple[str, bool], Player]

    @property
    def speaker(self) -> str:
        """Who prompts and praises: the robot, or else the adult."""
        if self.session.robot is not None:
            return self.session.robot.id
        return next(person.id for person in self.session.circle if person.role != "child")


def play_turn(table: Table, turn: PlannedTurn, record: TurnRecord) -> None:
    """Play one turn; what happens is written into ``record`` as it happens.

    Args:
        table: everybody.
        turn: as planned.
        record: empty but for its log.
    """
    model, imitator = table.session.participant(turn.model), table.session.participant(turn.imitator)
    record.states.append(("2_turn", table.clock.now, f"{turn.model} → {turn.imitator}: {turn.target or 'own choice'}"))
    record.states.append(("3_doing", table.clock.now, "model"))
    if model.role == "child":
        table.voice.speak(record.log, "instruction", "own_turn", table.speaker)
    if table.robot is not None:
        home = table.robot.come_home()
        record.motions += [] if home is None else [home]
    seen = _model(table, turn, model, record)
    if isinstance(imitator.turns, Robot):
        # What is written down of the model takes a tenth of a second that the robot's answer does not wait for.
        _robot_answers(table, turn, None if seen is None else seen.watched, record)
        _write_model(table, seen, record)
        if model.role == "child" and turn.phase == "game" and not record.excluded:
            _praise(table, record)
    elif not record.excluded:
        _write_model(table, seen, record)
        _person_answers(table, turn, imitator, record)
    record.states.append(("3_doing", table.clock.now, "end"))


def _model(table: Table, turn: PlannedTurn, model: Participant, record: TurnRecord) -> Shown | None:
    """Let the model show its gesture; returns the film of a person."""
    if isinstance(model.model_source, Robot):
        _robot_models(table, turn, record)
        return None
    player = table.players.get((model.id, False))
    if player is None:
        return None
    attempt = player.attempt(turn, 0, answering=False)
    if attempt is None or attempt.film is None or attempt.excluded:
        record.exclude(attempt.excluded if attempt and attempt.excluded else "model_failed", "the model is on no film")
        return None
    shown = _watch(table, model.id, attempt, answering=False, number=0, record=record)
    if shown.watched.blind:
        record.exclude("camera_blind", shown.watched.problem or "the model's film shows nothing")
    return shown


def _write_model(table: Table, shown: Shown | None, record: TurnRecord) -> None:
    """Write down when a person modelled: all through a film; before a camera, which waits longer, while they move."""
    if shown is None:
        return
    seen = shown.watched
    moved = seen.movement() if table.session.live else None
    start, end = moved or (0.0, seen.seconds)
    record.row |= {"model_start_s": shown.start_s + start, "model_end_s": shown.start_s + end}
    record.log.add("model", shown.start_s + start, shown.start_s + end, who=shown.who, label=_label(seen))


def _robot_models(table: Table, turn: PlannedTurn, record: TurnRecord) -> None:
    assert table.robot is not None
    done = table.robot.perform(Answer(turn.target, False))
    record.motions.append(done)
    record.row |= {"model_start_s": done.start_s, "model_end_s": done.end_s}
    record.log.add("model", done.start_s, done.end_s, who=table.speaker, label=turn.target)
    if done.log.fallen:
        _fell(table, record)


def _fell(table: Table, record: TurnRecord) -> None:
    record.exclude("robot_fell")
    record.log.add("fault", table.clock.now, who=table.speaker, text="the robot fell")
    assert table.robot is not None
    table.robot.stand()


def _watch(table: Table, who: str, attempt: Attempt, answering: bool, number: int, record: TurnRecord) -> Shown:
    assert attempt.film is not None
    start = table.clock.now
    watched = table.watcher.watch(attempt.film)
    table.clock.until(start + watched.seconds)
    shown = Shown(who, start, watched, answering, attempt.cut, number)
    record.films.append(shown)
    return shown


def _label(seen: Watched) -> str | None:
    return None if seen.recognition is None else seen.recognition.label


def _note_seen(seen: Watched, table: Table, record: TurnRecord) -> None:
    """Write down what was recognised and why."""
    among = table.session.among or ()
    record.row |= {"seen": None, "seen_among": among, "seen_reason": seen.problem}
    found = seen.recognition
    if found is None:
        return
    nearest = ", ".join(dict.fromkeys(n.label for n in found.neighbours[:3]))
    why = found.reason or f"nearest: {nearest}"
    record.row |= {
        "seen": found.label,
        "seen_distance": round(float(found.distance), 4),
        "seen_limit": round(float(found.threshold), 4),
        "seen_reason": "; ".join([why, *found.warnings]),
    }


def _robot_answers(table: Table, turn: PlannedTurn, seen: Watched | None, record: TurnRecord) -> None:
    """Let the robot imitate what it has just seen, at once; scores and records come after its first command."""
    assert table.robot is not None
    if seen is None:
        record.exclude("model_failed", "the robot saw no model")
        return
    record.states.append(("3_doing", table.clock.now, "imitate"))
    found = seen.recognition
    answer = Answer(None, False, seen.problem) if found is None else answer_to(found, table.session.mirror)
    done = table.robot.perform(answer)
    delay = round(done.began - seen.ended, 4)
    record.motions.append(done)
    _note_seen(seen, table, record)
    target = turn.target or record.row["seen"]
    record.row["target"] = target or "unknown"
    if turn.target is None:
        record.say("own choice: the target is what was recognised")
    if answer.gesture is None:
        record.say(f"the robot stood still: {answer.reason}")
        if target is None:
            record.exclude("model_failed", "none of the known gestures was seen")
    else:
        record.row["answer_delay_s"] = delay
        record.log.add("movement", done.start_s, done.end_s, who=table.speaker, label=answer.gesture)
        record.row |= {"movement_start_s": done.start_s, "movement_end_s": done.end_s, "prompt_level": 0}
    if done.log.fallen:
        _fell(table, record)
    if target is not None and not record.excluded:
        _propose(table, target, answer.gesture, record, done.start_s)


def _propose(table: Table, target: str, seen: str | None, record: TurnRecord, at: float | None = None) -> bool:
    """Write the automatic proposal down, for a moment or for now; returns whether it counts as answered."""
    scoring = table.session.scoring
    made = propose(target, seen, scoring)
    record.row |= {
        "auto_score": made.score, "auto_rule": scoring.rule, "auto_scale": scoring.scale, "side": made.side,
    }  # fmt: skip
    record.states.append(("5_proposed", table.clock.now if at is None else at, f"score {made.score}"))
    return made.score >= scoring.success_at


def _person_answers(table: Table, turn: PlannedTurn, imitator: Participant, record: TurnRecord) -> None:
    """Let a person imitate, with more help after each failure; in the baseline without any feedback."""
    helped = turn.phase == "game" and imitator.role == "child"
    if turn.target is None:
        model = record.films[-1].watched if record.films else None
        target = None if model is None else _label(model)
        record.row["target"] = target or "unknown"
        record.say("own choice: the target is what was recognised")
    else:
        target = turn.target
    record.row["instruction_s"] = table.voice.speak(record.log, "instruction", "instruction", table.speaker)
    player = table.players[imitator.id, True]
    level, answered, number = 0, False, 0
    while True:
        attempt = player.attempt(turn, number, answering=True)
        if attempt is None:
            break
        level = level if attempt.prompt is None else attempt.prompt
        if attempt.excluded is not None:
            record.exclude(attempt.excluded, "as the session file says")
        if level and not record.excluded:
            _prompt(table, turn, level, attempt, record)
        if record.excluded:
            break
        record.row["prompt_level"] = level
        record.states.append(("3_doing", table.clock.now, "answer"))
        record.states.append(("4_help", table.clock.now, PROMPT_LEVELS[level]))
        answered = _one_answer(table, imitator, attempt, number, target, record)
        number += 1
        declared = attempt.prompt is not None
        if record.excluded or (not declared and (answered or not helped or level >= table.session.prompting.highest)):
            break
        level += 1
    if answered and helped and not record.excluded:
        _praise(table, record)


def _one_answer(
    table: Table, imitator: Participant, attempt: Attempt, number: int, target: str | None, record: TurnRecord
) -> bool:
    """Watch one attempt and propose its score; returns whether it counts as answered."""
    if attempt.film is None:
        begun = table.clock.now
        table.clock.spend(table.session.timeout_s)
        record.row |= {"seen": None, "seen_reason": "nobody moved within the time-out"}
        _censored(record, begun, table.clock.now)
        return target is not None and _propose(table, target, None, record)
    shown = _watch(table, imitator.id, attempt, answering=True, number=number, record=record)
    _note_seen(shown.watched, table, record)
    if shown.watched.blind or shown.watched.recognition is None:
        record.exclude("camera_blind", shown.watched.problem or "the film shows nothing")
        return False
    _times(table, imitator, attempt, shown, record)
    return target is not None and _propose(table, target, _label(shown.watched), record)


def _times(table: Table, imitator: Participant, attempt: Attempt, shown: Shown, record: TurnRecord) -> None:
    """Write down when the imitator moved, and the latency where the film tells it."""
    moved = shown.watched.movement()
    record.row |= {"latency_s": None, "latency_censored": False, "waited_s": None}
    if moved is None:
        still = shown.watched.recognition is not None and shown.watched.recognition.evidence is not None
        if still and attempt.starts_at_model_end:
            end = shown.end_s
            if not table.session.live and attempt.cut is None:  # an actor is filmed for less than they are waited for
                end = shown.start_s + table.session.timeout_s
                table.clock.until(end)
            _censored(record, shown.start_s, end)
        return
    start, end = (round(shown.start_s + moment, 4) for moment in moved)
    record.log.add("movement", start, end, who=imitator.id, label=_label(shown.watched))
    if not attempt.starts_at_model_end:
        record.say("when this film began after the model's end is not known: no latency")
        return
    record.row |= {"movement_start_s": start, "movement_end_s": end}
    # A model on no film has ended when the answer's film begins, for so the session file says.
    model_end = record.row.setdefault("model_end_s", round(shown.start_s, 4))
    record.row["latency_s"] = round(start - model_end, 4)


def _censored(record: TurnRecord, since: float, now: float) -> None:
    model_end = record.row.get("model_end_s")
    waited = round(now - (since if model_end is None else model_end), 4)
    record.row |= {"latency_s": None, "latency_censored": True, "waited_s": waited}


def _prompt(table: Table, turn: PlannedTurn, level: int, attempt: Attempt, record: TurnRecord) -> None:
    """Help: say it, and at level 2 show the model again."""
    begun = table.voice.speak(record.log, "prompt", f"prompt_{level}", table.speaker, level=level)
    if attempt.cut is None and attempt.prompt is None:
        record.row["prompt_s"] = begun
        if level == MODEL_AGAIN and table.robot is not None and turn.model == table.speaker:
            _robot_models(table, turn, record)
    else:
        record.say("the films do not tell when help was given")


def _praise(table: Table, record: TurnRecord) -> None:
    if not table.session.prompting.praise:
        return
    record.row["praise_s"] = table.voice.speak(record.log, "praise", "praise", table.speaker)
    record.states.append(("3_doing", table.clock.now, "praise"))
    if table.robot is not None:
        record.motions.append(table.robot.game_gesture("congratulate"))
