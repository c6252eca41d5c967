import re
from dataclasses import replace
from pathlib import Path
from xml.etree import ElementTree

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.exchange.elan import eaf_faults, export_eaf, merge_eaf, parse_eaf
from nao_sim.exchange.elan.reading import read_tiers
from nao_sim.exchange.errors import ExchangeError
from nao_sim.game.tables import Event, Tables, check_tables
from tests.game.studies import made, session_of
from tests.game.test_tables import rating, session, turn

NOW = "2027-03-02T10:00:00+05:30"


@pytest.fixture(scope="module")
def tables():
    return session_of(made(7, children=3, turns=12, scale="0/1/2"), "S01")


def written(tables, **options):
    return parse_eaf("own", export_eaf(tables, NOW, **options)[0])


def tier(root, name):
    return next(t for t in root.iter("TIER") if t.get("TIER_ID") == name)


def add(root, tier_name, start_ms, end_ms, value, key="a9001"):
    order = root.find("TIME_ORDER")
    for i, ms in enumerate((start_ms, end_ms)):
        ElementTree.SubElement(order, "TIME_SLOT", {"TIME_SLOT_ID": f"s{key}{i}", "TIME_VALUE": str(ms)})
    holder = ElementTree.SubElement(tier(root, tier_name), "ANNOTATION")
    values = {"ANNOTATION_ID": key, "TIME_SLOT_REF1": f"s{key}0", "TIME_SLOT_REF2": f"s{key}1"}
    ElementTree.SubElement(
        ElementTree.SubElement(holder, "ALIGNABLE_ANNOTATION", values), "ANNOTATION_VALUE"
    ).text = value


def refer(root, tier_name, parent, value, key):
    holder = ElementTree.SubElement(tier(root, tier_name), "ANNOTATION")
    values = {"ANNOTATION_ID": key, "ANNOTATION_REF": parent}
    ElementTree.SubElement(ElementTree.SubElement(holder, "REF_ANNOTATION", values), "ANNOTATION_VALUE").text = value


def first_key(root, tier_name):
    return tier(root, tier_name).find(".//*[@ANNOTATION_ID]").get("ANNOTATION_ID")


def score_tier(root, name, annotator, below="turn@C01"):
    values = {"TIER_ID": name, "LINGUISTIC_TYPE_REF": "score 0/1/2", "PARENT_REF": below}
    element = ElementTree.Element("TIER", values | ({"ANNOTATOR": annotator} if annotator else {}))
    root.insert(list(root).index(tier(root, below)) + 1, element)


def test_file_keeps_elans_rules_and_comes_back_unchanged(tables):
    root = written(tables)
    assert list(eaf_faults(root)) == []
    merged = merge_eaf(tables, root, NOW)
    assert merged.tables == tables
    assert (merged.news, merged.notes) == ((), ())


def test_header_is_eaf_3_with_both_links_and_the_last_id(tables):
    content, _ = export_eaf(tables, NOW, Path("/films/S 1/fülm.mp4"), Path("/films"))
    root = parse_eaf("own", content)
    assert (root.get("FORMAT"), root.get("VERSION"), root.get("DATE")) == ("3.0", "3.0", NOW)
    assert b"EAFv3.0.xsd" in content
    media = root.find("HEADER/MEDIA_DESCRIPTOR")
    assert media.get("MEDIA_URL") == "file:///films/S%201/f%C3%BClm.mp4"
    assert media.get("RELATIVE_MEDIA_URL") == "./S%201/f%C3%BClm.mp4"
    ids = [int(e.get("ANNOTATION_ID")[1:]) for e in root.iter() if e.get("ANNOTATION_ID")]
    last = next(p.text for p in root.iter("PROPERTY") if p.get("NAME") == "lastUsedAnnotationId")
    assert int(last) == max(ids)


def test_scores_use_the_vocabulary_and_name_their_rater(tables):
    root = written(tables)
    scores = tier(root, "score@C01@R1")
    assert scores.get("ANNOTATOR") == "R1"
    entries = {e.get("CVE_ID") for e in root.iter("CV_ENTRY_ML")}
    refs = [a.get("CVE_REF") for a in scores.iter("REF_ANNOTATION")]
    assert refs
    assert set(refs) <= entries


def test_a_second_raters_scores_come_back_as_ratings_beside_the_first(tables):
    root = written(tables)
    score_tier(root, "score@C01@R7", "R7")
    keys = {a.parent: a.value for t in read_tiers(root) if t.name == "turn_id@C01" for a in t.annotations}
    for n, (parent, _) in enumerate(keys.items()):
        refer(root, "score@C01@R7", parent, "2" if n else "no trial", f"a{9000 + n}")
    merged = merge_eaf(tables, root, NOW)
    added = [r for r in merged.tables.ratings if r.rater == "R7"]
    assert [(r.turn_id, r.score, r.excluded) for r in added] == [
        (key, 2 if n else None, None if n else "other") for n, key in enumerate(keys.values())
    ]
    assert merged.tables.ratings[: len(tables.ratings)] == tables.ratings
    check_tables(merged.tables)
    again = merge_eaf(merged.tables, root, NOW)
    assert again.tables == merged.tables


def test_a_changed_score_is_a_new_rating_and_the_old_one_stays(tables):
    root = written(tables)
    value = next(tier(root, "score@C01@R1").iter("ANNOTATION_VALUE"))
    value.text = "0" if value.text != "0" else "1"
    merged = merge_eaf(tables, root, NOW)
    assert len(merged.tables.ratings) == len(tables.ratings) + 1
    assert merged.tables.ratings[-1].when == NOW
    assert set(tables.ratings) <= set(merged.tables.ratings)


def test_what_no_rule_foresees_is_kept_and_not_kept_twice(tables):
    root = written(tables)
    kinds = ElementTree.Element(
        "TIER", {"TIER_ID": "Blick (grob)", "LINGUISTIC_TYPE_REF": "stretch", "PARTICIPANT": "C01"}
    )
    root.insert(2, kinds)
    add(root, "Blick (grob)", 61000, 62500, "zum Roboter")
    refer(
        root,
        "score@C01@R1",
        first_key(root, "turn@C01"),
        "toll",
        "a9002",
    )
    merged = merge_eaf(tables, root, NOW)
    mine = next(e for e in merged.tables.events if e.text == "zum Roboter")
    assert (mine.kind, mine.who, mine.start_s, mine.end_s, mine.origin) == (
        "mark",
        "C01",
        61.0,
        62.5,
        "ELAN Blick (grob)",
    )
    assert any(e.text == "toll" and e.turn_id for e in merged.tables.events)
    assert any("no score of 0/1/2" in note for note in merged.notes)
    assert merge_eaf(merged.tables, root, NOW).tables == merged.tables
    assert "Blick (grob)" in [t.name for t in read_tiers(written(merged.tables))]


def test_speech_is_added_corrected_and_labelled(tables):
    first = next(e for e in tables.events if e.kind == "speech")
    root = written(tables)
    add(root, "speech@C01", 1000, 1800, "Hallo NAO")
    for value in tier(root, "speech@C01").iter("ANNOTATION_VALUE"):
        if value.text == first.text:
            value.text = "berichtigt"
            break
    merged = merge_eaf(tables, root, NOW)
    speech = [e for e in merged.tables.events if e.kind == "speech"]
    assert len(speech) == len([e for e in tables.events if e.kind == "speech"]) + 1
    fixed = next(e for e in speech if e.text == "berichtigt")
    assert (fixed.start_s, fixed.label, fixed.turn_id) == (first.start_s, first.label, first.turn_id)
    new = next(e for e in speech if e.text == "Hallo NAO")
    assert (new.start_s, new.end_s, new.who) == (1.0, 1.8, "C01")


def test_what_was_deleted_in_elan_stays_here_and_is_said(tables):
    root = written(tables)
    root.remove(tier(root, "function@C01"))
    root.remove(tier(root, "speech@C01"))
    root.remove(tier(root, "score@C01@R1"))
    merged = merge_eaf(tables, root, NOW)
    assert merged.tables == tables
    assert any("speech@C01" in note and "kept" in note for note in merged.notes)
    assert any("ratings are not in the file" in note for note in merged.notes)


def test_a_prompt_level_changed_in_elan_does_not_vanish(tables):
    root = written(tables)
    value = next(tier(root, "prompt_level@C01").iter("ANNOTATION_VALUE"))
    value.text = "4"
    merged = merge_eaf(tables, root, NOW)
    assert merged.tables.turns == tables.turns
    assert any("prompt_level" in note for note in merged.notes)
    assert list(eaf_faults(written(merged.tables))) == []


def test_writing_into_a_file_people_worked_on_changes_nothing_in_it(tables):
    fewer = replace(tables, events=tables.events[: len(tables.events) // 2], ratings=tables.ratings[:3])
    root = written(fewer)
    add(root, "speech@C01", 1000, 1800, "Hallo")
    ElementTree.SubElement(root, "EXTERNAL_REF", {"EXT_REF_ID": "er1", "TYPE": "iso12620", "VALUE": "DC-1"})
    before = {(t.name, a.value, a.start_s) for t in read_tiers(root) for a in t.annotations}
    grown, notes = export_eaf(tables, NOW, base=parse_eaf("x", ElementTree.tostring(_sorted(root))))
    after = parse_eaf("x", grown)
    assert before <= {(t.name, a.value, a.start_s) for t in read_tiers(after) for a in t.annotations}
    assert after.find("EXTERNAL_REF").get("VALUE") == "DC-1"
    merged = merge_eaf(tables, after, NOW)
    assert [e.text for e in merged.tables.events[len(tables.events) :]] == ["Hallo"]
    assert notes == []


def _sorted(root):
    order = root.find("TIME_ORDER")
    order[:] = sorted(order, key=lambda slot: int(slot.get("TIME_VALUE")))
    return root


def test_slots_without_a_time_lie_between_their_neighbours():
    xml = """<ANNOTATION_DOCUMENT AUTHOR="" DATE="2027-03-01T10:00:00" VERSION="3.0"><HEADER/><TIME_ORDER>
    <TIME_SLOT TIME_SLOT_ID="slot_x1" TIME_VALUE="1000"/><TIME_SLOT TIME_SLOT_ID="abc"/>
    <TIME_SLOT TIME_SLOT_ID="ts3" TIME_VALUE="3000"/></TIME_ORDER><TIER TIER_ID="t" LINGUISTIC_TYPE_REF="x">
    <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a1" TIME_SLOT_REF1="slot_x1" TIME_SLOT_REF2="abc">
    <ANNOTATION_VALUE>one</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION>
    <ANNOTATION><ALIGNABLE_ANNOTATION ANNOTATION_ID="a2" TIME_SLOT_REF1="abc" TIME_SLOT_REF2="ts3">
    <ANNOTATION_VALUE>two</ANNOTATION_VALUE></ALIGNABLE_ANNOTATION></ANNOTATION></TIER></ANNOTATION_DOCUMENT>"""
    found = read_tiers(parse_eaf("x", xml.encode()))[0].annotations
    assert [(a.start_s, a.end_s) for a in found] == [(1.0, 2.0), (2.0, 3.0)]


BOMB = b'<!DOCTYPE x [<!ENTITY a "ha"><!ENTITY b "&a;&a;">]><ANNOTATION_DOCUMENT>&b;</ANNOTATION_DOCUMENT>'


@pytest.mark.parametrize(
    ("content", "says"),
    [
        (BOMB, "document type"),
        (BOMB.decode().encode("utf-16"), "document type"),
        (b"<a/>", "not an ELAN file"),
        (b"x", "no readable XML"),
    ],
)
def test_what_is_no_honest_eaf_is_refused_in_one_line(content, says):
    with pytest.raises(ExchangeError, match=says) as error:
        parse_eaf("x.eaf", content)
    assert "\n" not in str(error.value)


@pytest.mark.parametrize(
    ("damage", "says"),
    [
        (lambda r: r.append(r.find("TIER")), "order"),
        (lambda r: refer(r, "score@C01@R1", first_key(r, "turn@C01"), "1", "z1"), "two annotations refer"),
        (lambda r: add(r, "score@C01@R1", 1, 2, "1"), "is aligned where its type refers"),
        (lambda r: add(r, "turn@C01", 61000, 62000, "x"), "overlap"),
        (lambda r: next(r.iter("REF_ANNOTATION")).set("CVE_REF", "nowhere"), "no vocabulary holds"),
        (lambda r: next(r.iter("ALIGNABLE_ANNOTATION")).set("TIME_SLOT_REF2", "ts0"), "which is not there"),
        (lambda r: r.find("TIER").set("LINGUISTIC_TYPE_REF", "odd"), "of the type odd"),
        (lambda r: tier(r, "auto@C01").set("PARENT_REF", "odd"), "hangs below odd"),
    ],
)  # fmt: skip
def test_damage_that_the_schema_does_not_see_is_found(tables, damage, says):
    root = written(tables)
    damage(root)
    _sorted(root)
    assert any(says in fault for fault in eaf_faults(root))
    with pytest.raises(ExchangeError, match="damaged"):
        export_eaf(tables, NOW, base=root)


times = st.floats(0, 500, allow_nan=False)
spoken = st.lists(st.tuples(times, st.none() | st.floats(0, 5), st.text(max_size=8)), max_size=8)


@given(spoken)
@settings(max_examples=20, deadline=None)
def test_any_events_make_a_file_that_keeps_the_rules_and_comes_back(found):
    events = tuple(
        Event("S1", "speech", start, None if length is None else start + length, "C 1@x", text=text, label="answer")
        for start, length, text in found
    )
    tables = Tables((session(),), (turn(1, model_end_s=1.0),), (rating(1),), events)
    root = written(tables)
    assert list(eaf_faults(root)) == []
    assert merge_eaf(tables, root, NOW).tables == tables


def test_files_hold_no_character_that_xml_cannot(tables):
    odd = replace(tables, events=(*tables.events, Event("S01", "speech", 2.0, 3.0, "C01", text="a\x07b\x0cc\ud800")))
    content, _ = export_eaf(odd, NOW)
    assert not re.search(rb"[\x00-\x08\x0b\x0c\x0e-\x1f]", content)
    assert "abc" in [a.value for t in read_tiers(parse_eaf("x", content)) for a in t.annotations]


def test_turns_without_a_time_are_named_and_two_sessions_refused():
    tables = Tables((session(),), (turn(1), turn(2, model_end_s=3.0)))
    assert "S1/001" in export_eaf(tables, NOW)[1][0]
    with pytest.raises(ExchangeError, match="one session"):
        export_eaf(made(children=3), NOW)
