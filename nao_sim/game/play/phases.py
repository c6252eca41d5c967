"""What stands around the game: the orientation, in which the robot is introduced, and the closing."""

from __future__ import annotations

from collections.abc import Iterator

from nao_sim.episodes.episode import Answer
from nao_sim.episodes.imitate import answer_to_label
from nao_sim.game.play.turn import Table
from nao_sim.game.session import SessionFile
from nao_sim.game.store.turn_record import TurnRecord
from nao_sim.game.watch.watching import Watcher
from nao_sim.gestures import vocabulary

GREETING = "bye_right"


def rehearsal(session: SessionFile, watcher: Watcher) -> Iterator[Answer]:
    """Yield everything the robot may have to show."""
    yield Answer(None, False)
    for gesture in (*session.gestures, *session.orientation.gestures, GREETING):
        yield Answer(gesture, False)
    yield from (Answer(name, False) for name in ("congratulate",))
    playable = [name for name, entry in vocabulary().items() if entry.playable]
    for label in playable if session.among is None else session.among:
        yield answer_to_label(label, session.mirror)


def orientation(table: Table, record: TurnRecord) -> None:
    """Introduce the robot: motionless while it is spoken of, then moving (thesis, appendix 4 (1-4-1))."""
    if table.robot is None:
        return
    adult = next((person.id for person in table.session.circle if person.role not in ("robot", "child")), None)
    table.voice.speak(record.log, "speech", "introduction", adult)
    record.motions.append(table.robot.perform(Answer(None, False)))
    table.clock.spend(table.session.orientation.still_s)
    gestures = table.session.orientation.gestures
    if gestures:
        table.voice.speak(record.log, "speech", "moving", adult)
    for gesture in gestures:
        done = table.robot.perform(Answer(gesture, False))
        record.motions.append(done)
        record.log.add("model", done.start_s, done.end_s, who=table.speaker, label=gesture)
        home = table.robot.come_home()
        record.motions += [] if home is None else [home]


def closing(table: Table, record: TurnRecord) -> None:
    """Thank everybody, and wave."""
    table.voice.speak(record.log, "speech", "closing", table.speaker)
    if table.robot is not None:
        record.motions.append(table.robot.perform(Answer(GREETING, False)))
