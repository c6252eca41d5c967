"""Scores: the written rule, and people's ratings beside the proposal."""

from __future__ import annotations

import csv
import io
import sys
from pathlib import Path

import pytest

from nao_sim.game.errors import GameError
from nao_sim.game.play import play
from nao_sim.game.scoring.sheet import read_sheet, write_sheet
from nao_sim.game.scoring.sitting import sitting
from nao_sim.game.session import read_session
from nao_sim.game.session.related import propose, side_of
from nao_sim.game.session.session import Scoring
from nao_sim.game.store import SessionFolder
from recognizer import open_clip
from tests.game.films import clip, write_session


@pytest.mark.parametrize(
    ("rule", "target", "seen", "score", "side"),
    [
        ("same_class", "bye_right", "bye_right", 1, "same"),
        ("same_class", "bye_right", "bye_left", 1, "mirrored"),
        ("same_class", "bye_right", "bye_two_hands", 0, "other"),
        ("same_class", "bye_right", "stop", 0, "same"),
        ("same_class", "yes", "no", 0, None),
        ("same_class", "kowtow", None, 0, None),
        ("same_side", "bye_right", "bye_left", 0, "mirrored"),
        ("same_family", "bye_right", "stop", 1, "same"),
        ("same_family", "bye_right", "bye_left", 0, "mirrored"),
        ("same_family", "yes", "no", 1, None),
        ("same_family", "right_arm_up", "bye_right", 0, "same"),
    ],
)
def test_the_rule_of_related_and_the_side_apart_from_it(rule, target, seen, score, side):
    proposal = propose(target, seen, Scoring(rule=rule))
    assert (proposal.score, proposal.side) == (score, side)


def test_emerging_on_the_scale_of_three():
    three = Scoring(scale="0/1/2")
    assert [propose("bye_right", seen, three).score for seen in ("bye_left", "stop", "kowtow", None)] == [2, 1, 0, 0]


def test_a_rule_of_ones_own():
    own = Scoring(rule="custom", text="…", related={"stop": ("stop", "stop_hand")})
    assert [propose("stop", seen, own).score for seen in ("stop", "stop_hand", "bye_right")] == [1, 1, 0]


def test_sides():
    gestures = ("bye_right", "left_arm_pointing_left", "bye_two_hands", "stop", "left_stop", "yes", "kowtow", "three")
    assert [side_of(g) for g in gestures] == ["right", "left", "both", "right", "left", None, None, None]


@pytest.fixture(scope="module")
def played(tmp_path_factory) -> Path:
    """A session of four turns, the last of which is no trial."""
    folder = tmp_path_factory.mktemp("scored")
    films = [clip("bye_right"), clip("no"), '"none"', '{ excluded = "child_left" }']
    play(read_session(write_session(folder / "s.toml", films)), folder / "out")
    return folder / "out"


def test_a_blind_sitting_is_shuffled_the_same_way_each_time_and_leaves_out_what_is_no_trial(played):
    first, again = sitting(played, "R7", blind=True), sitting(played, "R7", blind=True)
    assert [item.turn.turn for item in first.items] == [item.turn.turn for item in again.items]
    assert sorted(item.turn.turn for item in first.items) == [1, 2, 3]
    orders = {tuple(item.turn.turn for item in sitting(played, f"R{k}", blind=True).items) for k in range(12)}
    assert len(orders) > 2


def test_a_sheet_goes_out_with_clips_and_comes_back_whole_or_not_at_all(played, tmp_path):
    mine = sitting(played, "R2", blind=True)
    assert write_sheet(mine, tmp_path / "sheet") == 3
    text = (tmp_path / "sheet" / "sheet.csv").read_text(encoding="utf-8")
    assert "triadic" not in text
    assert "dyadic" not in text
    filmed = next(item for item in mine.items if item.turn.turn == 1)
    assert open_clip(tmp_path / "sheet" / f"clip_{filmed.position:02d}.avi").frame_count == 24
    rows = list(csv.DictReader(io.StringIO(text)))
    # As a German spreadsheet saves it.
    filled = "\ufeffclip;asked;score;excluded;note\n" + "".join(f"{row['clip']};{row['asked']};1;;so\n" for row in rows)
    (tmp_path / "filled.csv").write_text(filled, encoding="utf-8")
    (tmp_path / "wrong.csv").write_text(filled.replace(";1;;", ";2;;", 3).replace(";2;;", ";1;;", 2), encoding="utf-8")
    with pytest.raises(GameError, match=r"line 4: score is '2'; write 0, 1"):
        read_sheet(mine, tmp_path / "wrong.csv")
    assert not [r for r in SessionFolder(played).ratings() if r.rater == "R2"]
    assert read_sheet(mine, tmp_path / "filled.csv") == 3
    kept = [r for r in SessionFolder(played).ratings() if r.rater == "R2"]
    assert {(r.score, r.blind, r.note) for r in kept} == {(1, True, "so")}
    assert [r.position for r in kept] == [1, 2, 3]


def test_keys_at_the_terminal_are_on_the_disk_one_by_one_and_the_proposal_stays(played, monkeypatch, capsys):
    from nao_sim.cli.score import score

    def rate(keys: str, rater: str) -> str:
        monkeypatch.setattr(sys, "stdin", io.StringIO(keys))
        score(played, rater=rater, player="none")
        return capsys.readouterr().out

    before = SessionFolder(played).played().turns
    out = rate("1\n?\nq\n", "R1")
    assert "2 turns left" in out
    assert len([r for r in SessionFolder(played).ratings() if r.rater == "R1"]) == 1
    out = rate("1\nx\n5\n", "R1")
    mine = [r for r in SessionFolder(played).ratings() if r.rater == "R1"]
    assert [(r.score, r.excluded) for r in mine] == [(1, None), (1, None), (None, "no_opportunity")]
    assert "R1: 1 of 2 (50 %) of turns alike" in out
    assert SessionFolder(played).played().turns == before
    assert "has rated all 3 turns" in rate("", "R1")


def test_a_rater_changes_their_mind_and_both_ratings_are_kept(played):
    mine = sitting(played, "R5", blind=False)
    mine.say(mine.items[0], 0)
    mine.say(mine.items[0], 1)
    kept = [r.score for r in SessionFolder(played).ratings() if r.rater == "R5"]
    assert kept == [0, 1]


def test_nobody_is_called_auto(played):
    with pytest.raises(GameError, match="cannot be called 'auto'"):
        sitting(played, "auto", blind=False)
