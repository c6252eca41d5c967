"""Playing sessions: what a turn's record says, what is no trial, and what a kill leaves behind."""

from __future__ import annotations

import fcntl
import os
import random
import signal
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path

import cv2
import numpy as np
import pytest

from nao_sim.game.errors import GameError
from nao_sim.game.play import play
from nao_sim.game.session import read_session
from nao_sim.game.store import SessionFolder, journal
from nao_sim.game.store.folder import JOURNAL, LOCK
from nao_sim.game.tables import Tables, read_tables
from nao_sim.resources import resource
from recognizer import Recognizer
from tests.game.films import clip, write_session


@pytest.fixture(scope="module")
def recognizer() -> Recognizer:
    return Recognizer.load(resource("assets", "databases", "dynamic.parquet"))


@pytest.fixture
def dark(tmp_path: Path) -> str:
    """A film with the lid on the camera."""
    path = tmp_path / "dark.avi"
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10, (160, 120))
    for _ in range(20):
        writer.write(np.full((120, 160, 3), 8, np.uint8))
    writer.release()
    return f'"{path}"'


def _play(tmp_path: Path, films: list[str], recognizer: Recognizer, **session: object) -> Tables:
    file = write_session(tmp_path / "s.toml", films, **session)  # type: ignore[arg-type]
    return play(read_session(file), tmp_path / "out", recognizer=recognizer)


def test_a_turn_says_what_was_asked_seen_and_proposed_and_when(tmp_path, recognizer):
    said: list[str] = []
    file = write_session(tmp_path / "s.toml", [clip("bye_right"), clip("bye_left"), clip("yes")])
    tables = play(read_session(file), tmp_path / "out", recognizer=recognizer, say=said.append)
    same, mirrored, other = tables.turns
    assert (same.target, same.seen, same.side, same.auto_score, same.prompt_level) == (
        "bye_right", "bye_right", "same", 1, 0,
    )  # fmt: skip
    assert same.latency_s is not None
    assert 0 <= same.latency_s < 1.5
    assert same.movement_start_s - same.model_end_s == pytest.approx(same.latency_s, abs=1e-3)
    assert (mirrored.target, mirrored.side, mirrored.auto_score) == ("stop", "mirrored", 0)
    assert (other.target, other.auto_score) == ("bye_right", 0)
    assert "Now you: do the same!" in said
    assert said.count("Well done!") == 1
    kinds = [event.kind for event in tables.events if event.turn_id == same.turn_id]
    assert kinds == ["instruction", "movement", "praise"]
    assert read_tables(tmp_path / "out") == tables


def test_what_is_no_trial_has_a_reason_and_no_score(tmp_path, recognizer, dark):
    films = [dark, '{ excluded = "child_left" }', '"none"']
    blind, left, still = _play(tmp_path, films, recognizer).turns
    assert (blind.excluded, blind.auto_score) == ("camera_blind", None)
    assert (left.excluded, left.auto_score) == ("child_left", None)
    assert (still.excluded, still.auto_score) == (None, 0)
    assert (still.latency_s, still.latency_censored, still.waited_s) == (None, True, 10.0)


def test_a_film_that_begins_anywhere_tells_no_latency(tmp_path, recognizer):
    (turn,) = _play(tmp_path, [clip("stop")], recognizer, more="starts_at_model_end = false").turns
    assert (turn.latency_s, turn.latency_censored, turn.movement_start_s) == (None, False, None)
    assert "not known" in turn.note


def test_the_baseline_gives_no_feedback(tmp_path, recognizer):
    said: list[str] = []
    file = write_session(tmp_path / "s.toml", [clip("bye_right")], baseline=1, turns=0)
    tables = play(read_session(file), tmp_path / "out", recognizer=recognizer, say=said.append)
    assert tables.turns[0].phase == "baseline"
    assert tables.turns[0].auto_score == 1
    assert not {event.kind for event in tables.events} & {"praise", "prompt"}


def test_help_that_the_films_name_is_kept_with_the_score(tmp_path, recognizer):
    tries = f"{{ tries = [{{ film = {clip('no')} }}, {{ film = {clip('bye_right')}, prompt = 2 }}] }}"
    (turn,) = _play(tmp_path, [tries], recognizer).turns
    assert (turn.auto_score, turn.prompt_level, turn.prompt_s) == (1, 2, None)


def test_pieces_of_one_long_film_named_or_found(tmp_path, recognizer):
    film = _long_film(tmp_path / "long.avi", ["bye_right", "bye_left"])
    text = (tmp_path / "s.toml").write_text
    base = write_session(tmp_path / "s.toml", [clip("stop"), clip("stop")]).read_text(encoding="utf-8")
    start = base.index("turns = { films")
    end = base.index("\n", start)
    for number, source in enumerate(("cuts = [[0.0, 3.9], [3.9, 8.0]]", 'cuts = "auto"')):
        text(base[:start] + f'turns = {{ film = "{film}", {source} }}' + base[end:], encoding="utf-8")
        tables = play(read_session(tmp_path / "s.toml"), tmp_path / f"out{number}", recognizer=recognizer)
        assert [turn.seen for turn in tables.turns] == ["bye_right", "bye_left"]
        assert tables.turns[1].film_s == pytest.approx(3.9, abs=0.5)


def _long_film(path: Path, names: list[str]) -> Path:
    """Sample clips one after the other, a second and a half of rest after each."""
    frames = []
    for name in names:
        capture = cv2.VideoCapture(str(resource("assets", "clips", f"{name}.avi")))
        while (read := capture.read())[0]:
            frames.append(cv2.resize(read[1], (160, 120)))
        frames += [frames[-1]] * 15
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter.fourcc(*"MJPG"), 10, (160, 120))
    for frame in frames:
        writer.write(frame)
    writer.release()
    return path


def test_a_finished_session_is_neither_replaced_nor_played_twice(tmp_path, recognizer):
    before = _play(tmp_path, [clip("stop")], recognizer)
    session = read_session(tmp_path / "s.toml")
    with pytest.raises(GameError, match="--resume or choose another --out"):
        play(session, tmp_path / "out", recognizer=recognizer)
    assert play(session, tmp_path / "out", resume=True, recognizer=recognizer).turns == before.turns
    write_session(tmp_path / "s.toml", [clip("no")])
    with pytest.raises(GameError, match="differs"):
        play(read_session(tmp_path / "s.toml"), tmp_path / "out", resume=True, recognizer=recognizer)


def test_two_runs_in_one_folder_are_refused(tmp_path, recognizer):
    session = read_session(write_session(tmp_path / "s.toml", [clip("stop")]))
    (tmp_path / "out").mkdir()
    with (tmp_path / "out" / LOCK).open("w") as other:
        fcntl.flock(other, fcntl.LOCK_EX)
        with pytest.raises(GameError, match="another run"):
            play(session, tmp_path / "out", recognizer=recognizer)
    play(session, tmp_path / "out", recognizer=recognizer)


def test_ctrl_c_stores_the_turn_as_aborted_and_the_session_goes_on_later(tmp_path, recognizer):
    session = read_session(write_session(tmp_path / "s.toml", [clip("bye_right"), clip("stop")]))

    def stop(text: str) -> None:
        raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        play(
            session, tmp_path / "out", recognizer=recognizer, say=lambda text: stop(text) if "Now you" in text else None
        )
    tables = play(session, tmp_path / "out", resume=True, recognizer=recognizer)
    assert [(turn.turn, turn.excluded) for turn in tables.turns] == [(1, "aborted"), (2, None)]


def test_a_torn_last_line_is_as_if_it_had_never_been_written(tmp_path):
    path = tmp_path / "j.jsonl"
    journal.append(path, {"a": 1})
    whole = path.read_bytes()
    journal.append(path, {"b": "ü"})
    for cut in range(len(whole), path.stat().st_size):
        torn = tmp_path / f"{cut}.jsonl"
        torn.write_bytes(path.read_bytes()[:cut])
        assert journal.read(torn) == [{"a": 1}]
        journal.append(torn, {"c": 3})
        assert journal.read(torn) == [{"a": 1}, {"c": 3}]
    path.write_bytes(b"x" + path.read_bytes()[1:])
    with pytest.raises(GameError, match="line 1, is damaged"):
        journal.read(path)


@pytest.mark.slow
def test_a_kill_at_any_moment_loses_at_most_the_turn_in_progress(tmp_path, recognizer):
    names = ["bye_right", "stop", "no", "stop"]
    file = write_session(tmp_path / "s.toml", [clip(name) for name in names])
    whole = play(read_session(file), tmp_path / "whole", recognizer=recognizer)
    out, rng, kept = tmp_path / "out", random.Random(4), 0
    for resume in (False, True):
        arguments = ["game", str(file), "--out", str(out), *(["--resume"] if resume else [])]
        child = subprocess.Popen(
            [sys.executable, "-c", "from nao_sim.cli import main; main()", *arguments],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
        )  # fmt: skip
        _wait_for_turns(out, kept + 1 + resume, child)
        time.sleep(rng.random())
        os.kill(child.pid, signal.SIGKILL)
        child.wait()
        finished = SessionFolder(out).played().turns
        assert len(finished) >= kept + 1
        kept = len(finished)
    tables = play(read_session(file), out, resume=True, recognizer=recognizer)
    assert [replace(turn, seen_distance=None) for turn in tables.turns] == [
        replace(turn, seen_distance=None) for turn in whole.turns
    ]


def _wait_for_turns(out: Path, count: int, child: subprocess.Popen[bytes]) -> None:
    while child.poll() is None:
        if (out / JOURNAL).exists() and (out / JOURNAL).read_bytes().count(b'"turn": {') >= count:
            return
        time.sleep(0.02)
