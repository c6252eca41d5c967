"""The example session of each design, played by simulated people and the simulated robot, and looked at afterwards."""

from __future__ import annotations

import json
from pathlib import Path

import pytest

from nao_sim.game.play import play
from nao_sim.game.review.gather import recordings
from nao_sim.game.session import read_session
from nao_sim.game.store import SessionFolder
from nao_sim.game.store.recording import recording_id
from nao_sim.game.tables import Tables
from nao_sim.resources import resource
from nao_sim.robot import Nao
from recognizer import Recognizer

pytestmark = [pytest.mark.slow, pytest.mark.usefixtures("gl")]

NAMES = ("crossover", "groups_dyadic", "groups_triadic", "single_case")


@pytest.fixture(scope="module")
def sessions(tmp_path_factory) -> dict[str, tuple[Path, Tables]]:
    """Every example, played once, all with one robot and one recogniser."""
    nao, recognizer = Nao(), Recognizer.load(resource("assets", "databases", "dynamic.parquet"))
    played = {}
    for name in NAMES:
        out = tmp_path_factory.mktemp(name) / "out"
        session = read_session(resource("assets", "sessions", f"{name}.toml"))
        played[name] = (out, play(session, out, nao=nao, recognizer=recognizer))
    return played


@pytest.mark.parametrize("name", NAMES)
def test_an_example_is_played_as_agreed(sessions, name):
    session = read_session(resource("assets", "sessions", f"{name}.toml"))
    _, tables = sessions[name]
    assert len(tables.turns) == session.baseline + (session.turns or 0)
    assert [turn.turn for turn in tables.turns] == list(range(1, len(tables.turns) + 1))
    assert tables.sessions[0].design == session.design
    for turn in tables.turns:
        assert turn.excluded is None
        if turn.imitator_role != "robot":
            assert (turn.latency_s is None) == turn.latency_censored
        assert turn.phase == "game" or not turn.prompt_level
    phases = [event.label for event in tables.events if event.kind == "phase"]
    assert {"orientation", "game", "closing"} <= set(phases)


def test_events_of_a_turn_come_in_their_order(sessions):
    _, tables = sessions["groups_triadic"]
    for turn in tables.turns:
        times = (turn.model_start_s, turn.model_end_s, turn.movement_start_s, turn.movement_end_s)
        known = [time for time in times if time is not None]
        assert known == sorted(known)
        if turn.prompt_s is not None:
            assert turn.prompt_level > 0


def test_the_robot_imitates_at_once_and_stays_upright(sessions):
    _, tables = sessions["groups_triadic"]
    answers = [turn for turn in tables.turns if turn.imitator_role == "robot" and turn.seen]
    assert answers
    assert all(turn.answer_delay_s is not None and turn.auto_score is not None for turn in answers)
    assert not [event for event in tables.events if event.kind == "fault"]


def test_a_turns_folder_shows_what_was_seen_and_why(sessions):
    out, tables = sessions["groups_triadic"]
    turn = next(t for t in tables.turns if t.imitator_role == "child")
    about = json.loads((out / turn.episode / "turn.json").read_text(encoding="utf-8"))
    assert about["turn"]["turn_id"] == turn.turn_id
    assert (out / turn.clip).is_file()
    assert about["seen"][-1]["label"] == turn.seen


def test_a_review_has_every_piece_of_a_session_as_one_recording(sessions, tmp_path):
    from rerun.chunk import RrdReader

    out, tables = sessions["single_case"]
    files = recordings([out], tmp_path)
    assert [file.parent.name for file in files if file.name == "turn.rrd"] == ["001", "002", "003", "004", "005"]
    identity = recording_id(tables.sessions[0].session, tables.sessions[0].started)
    entities = set()
    for file in files:
        (entry,) = RrdReader(file).recordings()
        assert entry.recording_id == identity
        entities |= {str(chunk.entity_path) for chunk in RrdReader(file).stream().to_chunks()}
    assert {"/story/1_phase", "/story/2_turn", "/story/4_help", "/story/5_proposed", "/video/frame"} <= entities
    assert {"/joints/RShoulderPitch/angle", "/joints/RShoulderPitch/max", "/decision"} <= entities


def test_what_people_scored_is_a_lane_of_its_own(sessions, tmp_path):
    from nao_sim.game.scoring.sitting import sitting

    out, _ = sessions["crossover"]
    mine = sitting(out, "R1", blind=False)
    mine.say(mine.items[0], 2)
    files = recordings([out], tmp_path)
    assert files[-1].parent == tmp_path
    assert SessionFolder(out).write_tables().ratings[0].score == 2


def test_many_sessions_below_one_folder(sessions, tmp_path):
    (tmp_path / "study").mkdir()
    for name in ("crossover", "single_case"):
        (tmp_path / "study" / name).symlink_to(sessions[name][0])
    (tmp_path / "work").mkdir()
    files = recordings([tmp_path / "study"], tmp_path / "work")
    assert len([file for file in files if file.name == "start.rrd"]) == 2
