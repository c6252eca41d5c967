import dataclasses
import subprocess
import sys
from pathlib import Path

import pyarrow.parquet as pq
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nao_sim.game.errors import GameError
from nao_sim.game.tables import Event, Rating, Session, Tables, Turn, from_csv, read_tables, to_csv, write_tables
from nao_sim.game.tables.folder import changed_by_hand
from nao_sim.game.tables.schema import TABLES, kind_of
from nao_sim.game.tables.scores import accept, latest_ratings

NOON = "2027-03-01T12:00:00+01:00"


def session(**changes):
    circle = ("robot:NAO", "therapist:T1", "child:007")
    return Session(
        **({"session": "S1", "started": NOON, "circle": circle, "condition": "triadic", "design": "groups"} | changes)
    )


def turn(number=1, **changes):
    fixed = {"phase": "game", "condition": "triadic", "design": "groups", "target": "bye_right"}
    people = {"model": "NAO", "model_role": "robot", "imitator": "007", "imitator_role": "child"}
    return Turn(**({"turn_id": f"S1/{number:03}", "session": "S1", "turn": number} | fixed | people | changes))


def rating(number=1, rater="R1", score: int | None = 1, when=NOON, **changes):
    return Rating(turn_id=f"S1/{number:03}", rater=rater, when=when, score=score, **changes)


EXAMPLE = Tables(
    sessions=(session(planned=("bye_right", "stop"), seed=7, order="drawn", film="film.mp4"),),
    turns=(
        turn(1, model_end_s=4.5, movement_start_s=5.75, latency_s=1.25, prompt_level=0, seen="bye_right", side="same",
             auto_score=1, auto_rule="same_class", auto_scale="0/1", seen_among=("bye_right", "stop")),
        turn(2, latency_censored=True, waited_s=8.0, prompt_level=2, note="=1+1", seen_reason="n/a"),
        turn(3, excluded="robot_fell", excluded_note='said "oh",\nthen fell'),
    ),
    ratings=(rating(1), rating(2, score=0), rating(1, "NA", 0, blind=True)),
    events=(Event("S1", "prompt", 3.0, who="NAO", turn_id="S1/002", level=1, text="-Du bist dran"),),
)  # fmt: skip


@pytest.mark.parametrize("ending", [".parquet", ".csv"])
def test_either_file_alone_brings_everything_back(tmp_path, ending):
    write_tables(tmp_path, EXAMPLE)
    other = ".csv" if ending == ".parquet" else ".parquet"
    for name in TABLES:
        (tmp_path / f"{name}{other}").unlink()
    assert read_tables(tmp_path) == EXAMPLE


def test_stored_turns_say_which_score_is_reported_and_whose(tmp_path):
    write_tables(tmp_path, EXAMPLE)
    table = pq.read_table(tmp_path / "turns.parquet")
    assert table["score"].to_pylist() == [1, 0, None]
    assert table["score_by"].to_pylist() == ["R1", "R1", None]
    assert table["confirmed"].to_pylist() == [True, True, False]
    assert table.schema.metadata[b"nao_sim.schema"] == b"turns/1"
    assert table.schema.field("latency_s").metadata[b"unit"] == b"s"


def test_csv_keeps_ids_and_never_runs_as_a_formula(tmp_path):
    write_tables(tmp_path, EXAMPLE)
    text = (tmp_path / "turns.csv").read_text()
    assert '"007"' in text
    assert '"\'=1+1"' in text
    assert '"\'n/a"' in text


def test_edited_csv_is_noticed(tmp_path):
    write_tables(tmp_path, EXAMPLE)
    assert changed_by_hand(tmp_path, EXAMPLE) == []
    path = tmp_path / "turns.csv"
    path.write_text(path.read_text().replace('"stop"', '"yes"'))
    path.write_text(path.read_text().replace('"bye_right","S1/001"', "x").replace("8.0", "9.0"))
    assert changed_by_hand(tmp_path, EXAMPLE) == ["turns.csv"]


text_cells = st.text(st.characters(exclude_categories=["Cs"]))


@given(text_cells, text_cells, st.floats(allow_nan=False, allow_infinity=False), st.none() | text_cells)
def test_any_text_and_number_survives_csv(note, who, start, label):
    kind = kind_of("events")
    rows = [Event("S1", "mark", start, who=who, text=note, label=label)]
    assert from_csv("x.csv", to_csv(kind, rows), kind) == rows


@pytest.mark.parametrize(
    ("changes", "says"),
    [
        ({"prompt_level": 5}, "prompt_level is 5"),
        ({"prompt_level": True}, "not a whole"),
        ({"phase": "gmae"}, "did you mean 'game'"),
        ({"latency_s": float("nan")}, "not a number"),
        ({"latency_censored": True, "latency_s": 10.0, "waited_s": 10.0}, "censored"),
        ({"model_start_s": 2.0, "model_end_s": 1.0}, "lies before"),
        ({"model_end_s": 2.0, "movement_start_s": 3.0, "latency_s": 0.4}, "latency_s is 0.4"),
        ({"auto_score": 2, "auto_rule": "same_class", "auto_scale": "0/1"}, "auto_score is 2"),
        ({"session": "S9"}, "sessions does not hold"),
        ({"condition": "dyadic"}, "its session says triadic"),
    ],
)
def test_impossible_turns_are_refused_in_one_line(tmp_path, changes, says):
    bad = dataclasses.replace(EXAMPLE, turns=(turn(1, **changes), turn(2)), ratings=(), events=())
    with pytest.raises(GameError, match=says):
        write_tables(tmp_path, bad)
    assert not list(tmp_path.iterdir())


def test_what_is_named_twice_is_refused(tmp_path):
    with pytest.raises(GameError, match="S1/001 stands there twice"):
        write_tables(tmp_path, Tables((session(),), (turn(1), turn(1))))


def test_rating_of_no_turn_is_refused(tmp_path):
    with pytest.raises(GameError, match="S1/009"):
        write_tables(tmp_path, dataclasses.replace(EXAMPLE, ratings=(rating(9),)))


def test_misspelt_column_is_refused_and_an_own_one_is_not(tmp_path):
    kind = kind_of("events")
    good = to_csv(kind, [Event("S1", "mark", 1.0)])
    with pytest.raises(GameError, match="did you mean 'start_s'"):
        from_csv("e.csv", good.replace('"start_s"', '"start_S_"'), kind)
    head, line = good.splitlines()
    assert from_csv("e.csv", f'{head},"x_mine"\n{line},5\n', kind) == [Event("S1", "mark", 1.0)]


def test_bad_cell_is_named_by_line_and_column():
    kind = kind_of("events")
    text = to_csv(kind, [Event("S1", "mark", 1.0)]).replace("1.0", '"1,5"')
    with pytest.raises(GameError, match="line 2: start_s is '1,5', not a number"):
        from_csv("e.csv", text, kind)


def test_newer_schema_is_refused():
    kind = kind_of("events")
    text = to_csv(kind, [Event("S1", "mark", 1.0)]).replace("events/1", "events/2")
    with pytest.raises(GameError, match="events/2, this nao-sim knows events/1"):
        from_csv("e.csv", text, kind)


def test_only_a_person_confirms_and_the_latest_word_counts():
    proposal = turn(1, auto_score=1, auto_rule="same_class", auto_scale="0/1")
    alone = accept(proposal, {}, None)
    assert (alone.score, alone.by, alone.confirmed) == (1, "auto", False)
    later = "2027-03-01T11:30:00+00:00"  # half an hour after noon in Europe, though its digits are smaller
    found = latest_ratings([rating(1, score=0, when=later), rating(1, score=1, when=NOON)])["S1/001"]
    assert accept(proposal, found, None).score == 0


def test_primary_rater_counts_before_the_blind_and_the_early():
    found = {r.rater: r for r in (rating(1, "R2", 0, blind=True), rating(1, "R1", 1))}
    assert accept(turn(1), found, None).by == "R1"
    assert accept(turn(1), found, "R2").score == 0
    missing = accept(turn(1), found, "R3")
    assert missing.score is None
    assert "not by the primary rater R3" in missing.dispute


def test_excluded_turn_never_has_a_score():
    out = accept(turn(1, excluded="robot_fell"), {"R1": rating(1, score=0)}, None)
    assert out.score is None
    assert out.excluded == "robot_fell"
    assert "scored a turn that the game excluded" in out.dispute


def test_list_of_columns_in_the_docs_is_current():
    script = Path(__file__).parents[2] / "tools" / "turn_tables.py"
    done = subprocess.run([sys.executable, script, "--check"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
