"""Checking and importing data sets: every fault is found, and what is imported is referenced, not copied."""

import shutil

import cv2
import numpy as np
import pytest
from typer.testing import CliRunner

from nao_sim.cli.dataset import dataset
from nao_sim.people.datasets.checking import check, contact_sheet
from nao_sim.people.datasets.importing import find, import_recordings
from nao_sim.people.datasets.manifest import read_manifest, write_manifest
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.avi_writer import AviWriter


def clip(path, seed, frames=12):
    rng = np.random.default_rng(seed)
    with AviWriter(path, 64, 48, 10, 80) as writer:
        for _ in range(frames):
            writer.write(cv2.resize(rng.integers(0, 255, (6, 8, 3), dtype=np.uint8), (64, 48)))


@pytest.fixture
def recordings(tmp_path):
    source = tmp_path / "mine"
    for k, (label, person) in enumerate([("yes", "ann"), ("yes", "ben"), ("no", "ann"), ("no", "ben")]):
        clip(source / label / f"{person}_1.avi", k)
    return source


@pytest.fixture
def imported(recordings, tmp_path):
    list(import_recordings(find(recordings), tmp_path / "set"))
    return tmp_path / "set"


def kinds(folder):
    return {problem.kind for problem in check(folder, read_manifest(folder))}


def test_a_folder_is_imported_by_reference(imported, recordings):
    rows = read_manifest(imported)
    assert {(row["label"], row["person"]) for row in rows} == {(a, b) for a in ("yes", "no") for b in ("ann", "ben")}
    assert all((imported / row["file"]).resolve().is_relative_to(recordings) for row in rows)
    assert not list(imported.rglob("*.avi"))
    assert all((row["frames"], row["width"], row["start"], row["end"]) == (12, 64, 0, 11) for row in rows)
    assert kinds(imported) == set()


def test_a_table_of_ranges_is_imported(recordings, tmp_path):
    clip(recordings / "long.avi", 9, 40)
    table = recordings / "ranges.csv"
    table.write_text(
        "file,start,end,label,person\nlong.avi,0,14,yes,cat\nlong.avi,15,39,no,cat\nno/ann_1.avi,,,no,ann\n"
    )
    list(import_recordings(find(table), tmp_path / "set"))
    rows = read_manifest(tmp_path / "set")
    assert [(row["start"], row["end"], row["label"]) for row in rows] == [(0, 14, "yes"), (15, 39, "no"), (0, 11, "no")]
    assert "duplicate" not in kinds(tmp_path / "set")


@pytest.mark.parametrize(
    ("line", "text"),
    [
        ("yes/ann_1.avi,0,99,yes,ann", "has 12 frames"),
        ("yes/ann_1.avi,0,9,yess,ann", "did you mean 'yes'"),
        ("yes/ann_1.avi,0,9,yes,", "line 2: no 'person'"),
        ("yes/gone.avi,0,9,yes,ann", "cannot be read"),
        ("yes/ann_1.avi,zero,9,yes,ann", "not a table"),
    ],
)
def test_faulty_tables_are_refused_in_one_line(recordings, tmp_path, line, text):
    table = recordings / "t.csv"
    table.write_text(f"file,start,end,label,person\n{line}\n")
    with pytest.raises(FilmError, match=text) as error:
        list(import_recordings(find(table), tmp_path / "set"))
    assert "\n" not in str(error.value)
    assert not (tmp_path / "set" / "manifest.csv").exists()


def test_a_name_that_does_not_tell_the_person_is_refused(recordings):
    clip(recordings / "yes" / "wave.avi", 5)
    with pytest.raises(FilmError, match="<person>_<take>"):
        find(recordings)


def test_a_sound_set_has_no_problems_and_each_fault_is_found(imported, recordings):
    rows = read_manifest(imported)

    def with_row(**change):
        write_manifest(imported, [*rows[1:], rows[0] | change])
        return kinds(imported)

    assert with_row() == set()
    assert with_row(label="yess") >= {"label"}
    assert with_row(file="gone.avi") == {"unreadable"}
    assert with_row(end=99) == {"range"}
    assert with_row(end=4) == {"short"}
    assert with_row(width=640) == {"size"}
    assert with_row(person="Ann ") == {"person"}
    assert with_row(file=rows[1]["file"], person=rows[1]["person"], label=rows[1]["label"]) >= {"duplicate"}
    shutil.copy(imported / rows[1]["file"], recordings / "twin.avi")
    assert "person" in with_row(file="../mine/twin.avi", person="someone")


def test_truncated_and_empty_files_are_unreadable(imported):
    rows = read_manifest(imported)
    (imported / rows[0]["file"]).write_bytes(b"")
    (imported / rows[1]["file"]).write_bytes(b"RIFF nothing that anyone could play")
    found = [problem.where for problem in check(imported, rows) if problem.kind == "unreadable"]
    assert sorted(found) == sorted(row["file"] for row in rows[:2])


def test_an_unbalanced_set_is_warned_about(imported):
    rows = read_manifest(imported)
    for k in range(8):
        clip(imported / "yes" / f"cat_{k}.avi", 50 + k)
    extra = [rows[0] | {"file": f"yes/cat_{k}.avi", "label": "yes", "person": "cat"} for k in range(8)]
    problems = check(imported, rows + extra)
    assert {problem.kind for problem in problems} == {"balance"}
    assert all(problem.warning for problem in problems)


def test_the_contact_sheet_has_a_line_for_each_label(imported):
    sheet = contact_sheet(imported, read_manifest(imported))
    assert sheet.shape == (2 * 90, 8 * 120, 3)


def test_the_command_exits_with_1_when_something_is_wrong(imported):
    run = CliRunner().invoke(dataset, ["check", str(imported)])
    assert run.exit_code == 0, run.output
    assert (imported / "contact_sheet.png").is_file()
    rows = read_manifest(imported)
    write_manifest(imported, [rows[0] | {"label": "hello"}, *rows[1:]])
    run = CliRunner().invoke(dataset, ["check", str(imported), "--json"])
    assert run.exit_code == 1
    assert "unknown label 'hello'" in run.output
