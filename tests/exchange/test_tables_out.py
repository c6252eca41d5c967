import csv
import io
import json
import math

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nao_sim.exchange.bids import bids_files, write_bids
from nao_sim.exchange.csv_dialects import Dialect, detect_dialect, read_sheet, rows_from, write_sheet
from nao_sim.exchange.csv_dialects.joining import join_sheet
from nao_sim.exchange.dream import JOINTS, ChildTrack, JointTrack, dream_bytes, dream_document
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.joints import track_from
from nao_sim.exchange.times import clock, seconds_of
from nao_sim.game.tables import Tables, check_tables
from nao_sim.game.tables.schema import kind_of
from tests.game.studies import made
from tests.game.test_tables import NOON, session, turn

TURNS = kind_of("turns")
GERMAN = (
    "\ufeffKind;Runde;Geste;Wert;Latenz;Ende\r\n"
    "007;1;bye_right;1;1,25;00:01:02,500\r\n"
    "NA;2;stop;0;;01:10.000\r\n"
)  # fmt: skip
COLUMNS = {
    "imitator": "kind",
    "turn": "Runde",
    "target": "Geste",
    "auto_score": "Wert",
    "latency_s": "Latenz",
    "model_end_s": "Ende",
}
SAME = {
    "session": "S1", "phase": "game", "condition": "triadic", "design": "groups", "model": "NAO", "model_role": "robot",
    "imitator_role": "child", "auto_rule": "same_class", "auto_scale": "0/1",
}  # fmt: skip


def test_a_german_sheet_is_read_as_it_is_meant():
    sheet = read_sheet("runden.csv", GERMAN.encode())
    assert (sheet.dialect.delimiter, sheet.dialect.decimal) == (";", ",")
    rows = rows_from(sheet, TURNS, COLUMNS, SAME)
    assert [r.imitator for r in rows] == ["007", "NA"]
    assert [r.latency_s for r in rows] == [1.25, None]
    assert [r.model_end_s for r in rows] == [62.5, 70.0]
    assert [r.turn_id for r in rows] == ["S1/001", "S1/002"]
    tables, new = join_sheet(Tables((), ()), "turns", sheet, COLUMNS, SAME | {"started": NOON})
    check_tables(tables)
    assert new == 2
    assert tables.sessions[0].circle == ("robot:NAO", "child:007", "child:NA")
    assert join_sheet(tables, "turns", sheet, COLUMNS, SAME | {"started": NOON})[1] == 0


def test_turn_that_is_there_and_says_something_else_is_refused():
    sheet = read_sheet("r.csv", GERMAN.encode())
    tables, _ = join_sheet(Tables((), ()), "turns", sheet, COLUMNS, SAME | {"started": NOON})
    other = read_sheet("r.csv", GERMAN.replace("stop", "yes").encode())
    with pytest.raises(ExchangeError, match=r"line 3: S1/002 is there already.*target"):
        join_sheet(tables, "turns", other, COLUMNS, SAME)


@pytest.mark.parametrize("delimiter", [",", ";", "\t", "|"])
@pytest.mark.parametrize("decimal", [".", ","])
@pytest.mark.parametrize("as_clock", [True, False])
def test_every_dialect_comes_back_without_being_told(delimiter, decimal, as_clock):
    rows = [
        turn(i, imitator="007", note=note, model_end_s=1.5 * i, seen_distance=0.25 * i, seen_among=("a", "b"))
        for i, note in enumerate(("=1+1", "a;b,c\t|d", 'say "oh"\nthen', "", "NA", "'tis", "n/a"), 1)
    ]
    content = write_sheet(TURNS, rows, Dialect(delimiter, decimal, bom=True, clock=as_clock))
    sheet = read_sheet("x.csv", content)
    assert sheet.dialect.delimiter == delimiter
    got = rows_from(sheet, TURNS, {}, {})
    assert [(r.imitator, r.model_end_s, r.seen_distance, r.seen_among) for r in got] == [
        (r.imitator, r.model_end_s, r.seen_distance, r.seen_among) for r in rows
    ]
    assert [r.note for r in got[:6]] == [r.note for r in rows[:6]]


@pytest.mark.parametrize(
    ("text", "says"),
    [
        (GERMAN.replace("1,25", "1,2,5"), r"line 2: latency_s is '1,2,5', not a number"),
        (GERMAN.replace("01:10.000", "01:75.000"), r"line 3: model_end_s"),
        (GERMAN.replace(";0;", ";0,5;"), r"line 3: auto_score is '0,5', not a whole"),
        (GERMAN.replace("Geste", "Gesten"), "did you mean 'Gesten'"),
        (GERMAN.replace("Runde", "Kind"), "two columns 'Kind'"),
        (GERMAN.replace("007;1", "007;1;9"), "line 2: 7 cells under 6 columns"),
        ("", "empty"),
    ],
)
def test_the_first_bad_cell_is_named_by_line(text, says):
    with pytest.raises(ExchangeError, match=says):
        rows_from(read_sheet("runden.csv", text.encode()), TURNS, COLUMNS, SAME)


def test_a_missing_column_says_how_to_bring_it():
    constants = {k: v for k, v in SAME.items() if k != "phase"}
    with pytest.raises(ExchangeError, match=r"no 'phase'.*--set phase=VALUE"):
        rows_from(read_sheet("r.csv", GERMAN.encode()), TURNS, COLUMNS, constants)


@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16", "cp1252"])
def test_encodings_of_office_programs(encoding):
    sheet = read_sheet("x.csv", "name;wert\nJürgen;1\n".encode(encoding))
    assert sheet.rows[0][1] == ("Jürgen", "1")


def test_excels_own_line_is_believed():
    assert detect_dialect("sep=;\na,b;c\n1,5;2\n").delimiter == ";"
    assert read_sheet("x", b"sep=;\na;c\n1;2\n").columns == ("a", "c")


def test_milliseconds_are_milliseconds_only_where_no_clock_is():
    sheet = read_sheet("x.csv", b"turn,model_end_s,movement_start_s\n1,62500,00:01:03.000\n")
    row = rows_from(sheet, TURNS, {}, SAME | {"imitator": "C", "target": "yes"}, milliseconds=True)[0]
    assert (row.model_end_s, row.movement_start_s) == (62.5, 63.0)


@given(st.integers(0, 400_000_000))
def test_clock_and_seconds_are_inverse(ms):
    assert seconds_of(clock(ms / 1000)) == pytest.approx(ms / 1000, abs=1e-9)


def test_bids_events_are_ordered_numbers_with_a_sidecar(tmp_path):
    files = bids_files(made(3, children=2))
    name = next(n for n in files if n.endswith("sub-C01_ses-S01_task-imitation_events.tsv"))
    lines = list(csv.reader(io.StringIO(files[name].decode()), delimiter="\t"))
    assert lines[0][:3] == ["onset", "duration", "trial_type"]
    onsets = [float(line[0]) for line in lines[1:]]
    assert onsets == sorted(onsets)
    assert all(float(line[1]) >= 0 for line in lines[1:])
    assert all(cell for line in lines for cell in line)
    assert {len(line) for line in lines} == {len(lines[0])}
    sidecar = json.loads(files[name.replace(".tsv", ".json")])
    assert set(lines[0][2:]) == set(sidecar)
    write_bids(tmp_path / "bids", made(3, children=2))
    with pytest.raises(ExchangeError, match="holds files already"):
        write_bids(tmp_path / "bids", made(3, children=2))


def test_bids_labels_that_fall_together_are_refused():
    tables = Tables((session(),), (turn(1, imitator="C-1"), turn(2, imitator="C1")))
    with pytest.raises(ExchangeError, match="both become sub-C1"):
        bids_files(tables)


def track(n=3, **joints):
    known = joints or {"head": JointTrack([1.0] * n, [-2.0] * n, [900.0] * n, [1.0] * n)}
    return ChildTrack(25.16, known)


def test_dream_has_ten_joints_and_null_where_nothing_is_known():
    document = json.loads(dream_bytes(dream_document(track(), 7, "triadic", "imitation", NOON)))
    assert set(document["skeleton"]) == set(JOINTS)
    assert "sholder_left" in document["skeleton"]
    assert document["skeleton"]["elbow_left"]["x"] == [None] * 3
    assert document["head_gaze"]["rx"] == [None] * 3
    assert document["frame_rate"] == 25.16
    assert (document["participant"]["id"], document["condition"], document["nao_sim_condition"]) == (
        7,
        "RET",
        "triadic",
    )


@pytest.mark.parametrize(
    ("bad", "says"),
    [
        (track(head=JointTrack([1.0], [1.0, 2.0], [1.0], [1.0])), "joints have"),
        (track(head=JointTrack([math.nan], [1.0], [1.0], [1.0])), "head.x sample 1 is nan"),
        (track(knee_left=JointTrack([1.0], [1.0], [1.0], [1.0])), "no joint 'knee_left'"),
        (ChildTrack(0.0, track().joints), "frame rate is 0"),
        (ChildTrack(25.0, {}), "nothing was measured"),
        (ChildTrack(25.0, {}, head_gaze=([0.5], [0.5], [0.1])), "a heading has length 1"),
    ],
)
def test_what_dreams_schema_lets_pass_is_refused(bad, says):
    with pytest.raises(ExchangeError, match=says):
        dream_document(bad, 1, "dyadic", "imitation")


def test_joints_come_from_a_table_and_gaps_stay_gaps():
    text = "time;head.x;head.y;head.z;shoulder_left.x\n0;0,1;0,2;0,9;\n0,04;;;;0,3\n0,08;0,1;0,2;0,9;0,3\n"
    found = track_from(read_sheet("j.csv", text.encode()), metres=True)
    assert found.frame_rate == 25.0
    assert found.joints["head"].x == [100.0, None, 100.0]
    assert found.joints["head"].confidence == [None] * 3
    assert found.joints["sholder_left"].x == [None, 300.0, 300.0]
    with pytest.raises(ExchangeError, match="not evenly spaced"):
        track_from(read_sheet("j.csv", text.replace("0,08", "9").encode()))
