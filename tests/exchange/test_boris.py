import gzip
import json
from pathlib import Path

import pytest

from nao_sim.exchange.boris import boris_faults, export_boris, merge_boris, parse_boris
from nao_sim.exchange.boris.media import MediaFacts
from nao_sim.exchange.errors import ExchangeError
from nao_sim.game.tables import Event, Tables, check_tables
from tests.game.studies import made
from tests.game.test_tables import rating, session, turn

NOW = "2027-03-02T10:00:00+01:00"


@pytest.fixture(scope="module")
def tables():
    return made(7, children=2, turns=8)


@pytest.fixture
def project(tables):
    return parse_boris("own", export_boris(tables, NOW))


def test_project_has_what_boris_needs_and_comes_back_unchanged(tables, project):
    assert list(boris_faults(project)) == []
    assert project["project_format_version"] == "7.0"
    merged = merge_boris(tables, project, NOW)
    assert merged.tables == tables
    assert (merged.news, merged.notes) == ((), ())


def test_states_pair_and_modifiers_are_text(project):
    states = {b["code"] for b in project["behaviors_conf"].values() if b["type"] == "State event"}
    for observation in project["observations"].values():
        keys = [tuple(e[1:4]) for e in observation["events"] if e[2] in states]
        assert all(keys.count(key) % 2 == 0 for key in keys)
        assert all(isinstance(e[3], str) for e in observation["events"])


def test_a_film_makes_a_media_observation_with_frames(tables):
    film = {"S01": (Path("/films/a.mp4"), MediaFacts(300.0, 25.0))}
    observation = parse_boris("own", export_boris(tables, NOW, film))["observations"]["S01"]
    assert observation["type"] == "MEDIA"
    assert set(observation["media_info"]["length"]) == set(observation["file"]["1"])
    assert all(len(e) == 6 and e[5] == round(e[0] * 25) for e in observation["events"])


def test_coded_scores_become_ratings_and_other_codes_events(tables, project):
    events = project["observations"]["S01"]["events"]
    events += [[70.0, "C01", "score", "R9|1", "S01/001"], [71.0, "C01", "Lachen", "laut", "quer"]]
    merged = merge_boris(tables, project, NOW)
    assert [(r.turn_id, r.score) for r in merged.tables.ratings if r.rater == "R9"] == [("S01/001", 1)]
    assert merged.tables.events[-1] == Event(
        "S01", "mark", 71.0, None, "C01", None, None, None, "Lachen laut quer", "BORIS"
    )
    check_tables(merged.tables)
    assert merge_boris(merged.tables, project, NOW).tables == merged.tables


def test_scores_whose_turn_is_not_said_are_kept_as_marks(tables, project):
    project["observations"]["S01"]["events"].append([70.0, "C01", "score", "None|1", ""])
    merged = merge_boris(tables, project, NOW)
    assert merged.tables.ratings == tables.ratings
    assert "score None|1" in merged.tables.events[-1].text


def test_a_start_without_stop_is_a_moment_and_is_said(tables, project):
    project["observations"]["S01"]["events"].append([500.0, "C01", "turn", "yes", "x"])
    merged = merge_boris(tables, project, NOW)
    assert any("has no end" in note for note in merged.notes)
    assert merged.tables.events[-1].end_s is None


def test_ends_that_boris_moved_by_a_millisecond_are_the_same(tables, project):
    for event in project["observations"]["S01"]["events"]:
        event[0] = round(event[0] + 0.001, 3)
    assert merge_boris(tables, project, NOW).tables == tables


def test_compressed_projects_are_read(tables):
    assert parse_boris("x.boris.gz", gzip.compress(export_boris(tables, NOW)))["project_name"]


def test_names_that_boris_forbids_in_modifiers_come_back_whole():
    tables = Tables((session(),), (turn(1, model_end_s=2.0, target="a|b(c)"),), (rating(1, "Dr. (M), x"),))
    project = parse_boris("own", export_boris(tables, NOW))
    assert list(boris_faults(project)) == []
    assert merge_boris(tables, project, NOW).tables == tables


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (b"[]", "no BORIS project"),
        (b'{"observations": {}, "project_format_version": "11.0"}', "project format 11.0"),
        (b'{"observations": {"S01": {"events": [[NaN]]}}}', "no readable BORIS project"),
        (b"\x1f\x8bnot gzip", "no readable BORIS project"),
    ],
)
def test_other_files_are_refused_in_one_line(content, says):
    with pytest.raises(ExchangeError, match=says):
        parse_boris("x.boris", content)


def test_strangers_and_broken_events_are_named(tables, project):
    with pytest.raises(ExchangeError, match="no observation is named as a session"):
        merge_boris(tables, {"observations": {"walk 1": {"events": []}}}, NOW)
    project["observations"]["S01"]["events"].append([1.0, "C01", "turn"])
    with pytest.raises(ExchangeError, match="is no event"):
        merge_boris(tables, project, NOW)


def test_damage_that_boris_does_not_report_is_found(project):
    del project["observations"]["S01"]["description"]
    project["observations"]["S02"]["events"][0][3] = 1
    faults = " ".join(boris_faults(json.loads(json.dumps(project))))
    assert "S01 lacks description" in faults
    assert "modifier 1" in faults
