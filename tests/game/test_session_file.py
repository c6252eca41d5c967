"""Session files: what an impossible one says, and in which order the turns of a possible one come."""

from __future__ import annotations

from collections import Counter
from dataclasses import replace
from itertools import islice
from pathlib import Path

import pytest

from nao_sim.game.errors import GameError
from nao_sim.game.session import Actor, Films, child_targets, plan_turns, read_session
from nao_sim.resources import resource

EXAMPLES = sorted(resource("assets", "sessions").glob("*.toml"))
TRIADIC = resource("assets", "sessions", "groups_triadic.toml").read_text(encoding="utf-8")


def _read(tmp_path: Path, text: str):
    file = tmp_path / "session.toml"
    file.write_text(text, encoding="utf-8")
    return read_session(file)


def _refusal(tmp_path: Path, text: str) -> str:
    with pytest.raises(GameError) as refused:
        _read(tmp_path, text)
    assert "\n" not in str(refused.value)
    return str(refused.value)


def test_each_design_has_an_example():
    designs = {read_session(path).design for path in EXAMPLES}
    assert designs == {"groups", "crossover", "single_case"}
    assert {read_session(path).condition for path in EXAMPLES} == {"triadic", "dyadic"}


@pytest.mark.parametrize(
    ("old", "new", "key", "mend"),
    [
        ('condition = "triadic" ', 'condition = "quadric" ', "study.condition", "did you mean"),
        ('"kowtow"]', '"kowtou"]', "game.gestures", "did you mean 'kowtow'"),
        ('"kowtow"]', '"right_arm_down"]', "game.gestures", "only communicative gestures"),
        ('"kowtow"]', '"walk_left_to_right"]', "game.gestures", "only communicative gestures"),
        ('"kowtow"]', '"walk_right_to_left"]', "game.gestures", "only communicative gestures"),
        ('"kowtow"]', '"three"]', "game.gestures", "actor C07 cannot show"),
        ('"kowtow"]', '"stop"]', "game.gestures", "twice"),
        ("turns = 12", "turnes = 12", "game.turnes", "did you mean 'turns'"),
        ("turns = 12", "turns = 12\nminutes = 5", "game.minutes", "leave one out"),
        ("turns = 12", "", "game.turns", "write turns or minutes"),
        ("turns = 12", "turns = -1", "game.turns", "whole number from 0"),
        ("timeout_s = 10", 'timeout_s = "10"', "game.timeout_s", "number from 1"),
        ("highest = 2", "highest = 5", "prompts.highest", "0 to 4"),
        ('rule = "same_class"', 'rule = "custom"', "score.text", "custom rule"),
        ("success_at = 1", "success_at = 2", "score.success_at", "from 1 to 1"),
        ('role = "therapist"', 'role = "child"', "study.condition", "without a therapist"),
        ('id = "T02"', 'id = "C07"', "participant", "'C07'"),
        ("{ actor = 21,", "{ actress = 21,", "participant T02.turns", "did you mean 'actor'"),
        ("{ actor = 21, child = false, follows = 1.0", "{ actor = 21, follows = 2", "T02.turns.follows", "0 to 1"),
        (
            "{ actor = 21, child = false, follows = 1.0, mirrors = 0.0 }",
            '{ films = "*.mp4" }',
            "T02.turns.films",
            "no file",
        ),
        (
            "{ actor = 21, child = false, follows = 1.0, mirrors = 0.0 }",
            '{ film = "no.mp4" }',
            "T02.turns.film",
            "no such",
        ),
        ('session = "C07-1"', 'session = "C07/1"', "session", "no real name"),
        ('id = "NAO"\nrole = "robot"', 'id = "NAO"\nrole = "robot"\nturns = "unseen"', "NAO.turns", "leave turns out"),
    ],
)
def test_an_impossible_file_gets_one_line_with_the_key_and_the_mend(tmp_path, old, new, key, mend):
    assert old in TRIADIC
    message = _refusal(tmp_path, TRIADIC.replace(old, new, 1))
    assert key in message
    assert mend in message


def test_a_file_that_is_none(tmp_path):
    with pytest.raises(GameError, match="nao-sim game --new"):
        read_session(tmp_path / "none.toml")
    assert "is not TOML" in _refusal(tmp_path, "session = ")


def test_dyadic_has_no_robot(tmp_path):
    text = TRIADIC.replace('condition = "triadic" ', 'condition = "dyadic" ', 1)
    assert "take the robot out" in _refusal(tmp_path, text)


def test_too_few_films_are_said_before_anything_is_played(tmp_path):
    from tests.game.films import clip, write_session

    with pytest.raises(GameError, match="has 1 turns on film where 0 baseline and 3 game turns need 3"):
        read_session(write_session(tmp_path / "s.toml", [clip("stop")], turns=3))


def test_tries_prompts_and_reasons_of_films(tmp_path):
    from tests.game.films import clip, write_session

    tries = f"{{ tries = [{{ film = {clip('no')} }}, {{ film = {clip('stop')}, prompt = 2, from = 0.5 }}] }}"
    films = [tries, '"none"', '{ excluded = "child_left" }']
    source = read_session(write_session(tmp_path / "s.toml", films)).participant("C01").turns
    assert isinstance(source, Films)
    assert [[t.prompt for t in turn] for turn in source.turns] == [[0, 2], [0], [0]]
    assert source.turns[0][1].cut.from_s == 0.5
    assert source.turns[1][0].cut is None
    assert source.turns[2][0].excluded == "child_left"
    with pytest.raises(GameError, match=r"films\[1\].excluded is 'child_gone'; did you mean 'child_left'"):
        read_session(write_session(tmp_path / "s.toml", ['{ excluded = "child_gone" }']))


def test_who_imitates_whom_goes_round_in_the_direction_of_the_circle():
    session = read_session(EXAMPLES[0].with_name("groups_triadic.toml"))
    pairs = [(turn.model, turn.imitator) for turn in plan_turns(session, 1) if turn.phase == "game"]
    assert pairs[:4] == [("NAO", "C07"), ("C07", "T02"), ("T02", "NAO"), ("NAO", "C07")]
    back = replace(session, direction="counterclockwise")
    pairs = [(turn.model, turn.imitator) for turn in plan_turns(back, 1) if turn.phase == "game"]
    assert pairs[:3] == [("NAO", "T02"), ("T02", "C07"), ("C07", "NAO")]


def test_a_baseline_is_modelled_by_a_person_for_the_child():
    session = read_session(EXAMPLES[0].with_name("groups_triadic.toml"))
    baseline = [turn for turn in plan_turns(session, 1) if turn.phase == "baseline"]
    assert {(turn.model, turn.imitator) for turn in baseline} == {("T02", "C07")}


def test_a_drawn_order_is_balanced_and_follows_from_its_seed():
    session = replace(read_session(EXAMPLES[0].with_name("groups_triadic.toml")), turns=46, baseline=0)
    targets = child_targets(session, 5)
    assert targets == child_targets(session, 5)
    assert targets != child_targets(session, 6)
    assert Counter(targets[:16]) == dict.fromkeys(session.gestures, 4)


def test_turns_that_nobody_sees_are_not_planned():
    session = read_session(EXAMPLES[0].with_name("crossover.toml"))
    assert {turn.imitator for turn in islice(plan_turns(session, 0), 10)} == {"K3", "K4"}


def test_every_example_names_actors_that_can_be_filmed():
    for path in EXAMPLES:
        assert any(isinstance(person.turns, Actor) for person in read_session(path).circle)
