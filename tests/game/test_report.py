import json
import re
from dataclasses import replace
from html.parser import HTMLParser

import pyarrow.parquet as pq
import pytest
from typer.testing import CliRunner

from nao_sim.cli.app import _app
from nao_sim.episodes.errors import EpisodeError
from nao_sim.game.errors import GameError
from nao_sim.game.report import write_report
from nao_sim.game.report.links import film_link
from nao_sim.game.study import gather
from nao_sim.game.tables import Event, Tables
from tests.game.studies import made, store, with_settings
from tests.game.test_study import one
from tests.game.test_tables import rating, turn


def report_of(tables, tmp_path, **options):
    store(tables, tmp_path / "study")
    write_report(gather([tmp_path / "study"]), tmp_path / "out", **options)
    return (tmp_path / "out" / "report.html").read_text(encoding="utf-8")


class Tags(HTMLParser):
    """The elements of a page and its plain text."""

    def __init__(self, page):
        super().__init__()
        self.tags, self.text = [], []
        self.feed(page)

    def handle_starttag(self, tag, attrs):
        self.tags.append((tag, dict(attrs)))

    def handle_data(self, data):
        self.text.append(data)

    @property
    def words(self):
        return " ".join(" ".join(self.text).split())


def test_page_fetches_nothing_and_runs_nothing(tmp_path):
    page = report_of(made(children=3), tmp_path)
    tags = Tags(page).tags
    assert not {tag for tag, _ in tags} & {"script", "link", "img", "iframe", "object", "video"}
    assert "default-src 'none'" in page
    links = [a["href"] for _, a in tags if "href" in a]
    assert links
    assert not [href for href in links if re.match(r"[a-z]+:|//", href)]


def test_text_from_the_tables_is_never_markup(tmp_path):
    evil = '<script>alert("x")</script>&{{ 7*7 }}\x07'
    turns = [
        turn(1, imitator=evil, target=evil, excluded="aborted", excluded_note=evil),
        turn(2, imitator=evil, film=evil),
    ]
    tables = one(
        turns, [rating(2, evil)], [Event("S1", "fault", 1.0, text=evil)], study=evil, rule_text=evil, assignment=evil
    )
    page = report_of(tables, tmp_path)
    assert "<script" not in page
    assert "\x07" not in page
    assert "{{ 7*7 }}" in Tags(page).words


def test_therapists_page_says_what_a_therapist_asks(tmp_path):
    old = "2027-02-22T12:00:00+01:00"
    turns = [turn(i, prompt_level=0, film_s=10.0 * i) for i in range(1, 11)]
    turns[8] = replace(turns[8], prompt_level=1)
    turns += [turn(11, excluded="robot_fell"), turn(12, excluded="child_left")]
    ratings = [rating(i, score=0 if i in (3, 4) else 1) for i in range(1, 10)]
    ratings += [rating(1, "R2", 0)]
    turns[9] = replace(turns[9], auto_score=1, auto_rule="same_class", auto_scale="0/1")
    events = [Event("S1", "speech", 5.0, who="007", label="initiation", text="noch mal")]
    now = one(turns, ratings, events, film="film.mp4", duration_s=120.0, primary_rater="R1")
    before = replace(now.sessions[0], session="S0", started=old)
    earlier = [replace(turn(1, prompt_level=0), session="S0", turn_id="S0/001")]
    base = [replace(turn(2, prompt_level=0), session="S0", turn_id="S0/002", phase="baseline")]
    both = Tables(
        (before, *now.sessions), (*earlier, *base, *now.turns),
        (*now.ratings, replace(rating(), turn_id="S0/001"), replace(rating(score=0), turn_id="S0/002")), now.events,
    )  # fmt: skip
    words = Tags(report_of(both, tmp_path)).words
    assert "7 of 10 independent" in words.replace("independent 1 of", "independent")
    assert "1 of the scores not yet confirmed" in words
    assert "Last time (22 February 2027): 1 of 1 independent" in words
    assert "Baseline: 0 of 1 independent" in words
    assert "8 of 10 with or without help" in words
    assert "Turn 11: the robot fell" in words
    assert "Turn 12: the child left" in words
    assert "1 initiation (0.5 a minute), 0 answers" in words
    assert "Turn 10: automatic score, not yet confirmed by a person" in words
    assert "Turn 1: R1 says 1 and R2 says 0" in words
    page = (tmp_path / "out" / "report.html").read_text()
    assert 'href="../study/S1/film.mp4#t=30.0"' in page


def test_no_p_value_on_a_therapists_page(tmp_path):
    page = report_of(made(children=4), tmp_path)
    therapist = page[: page.index('id="study-1"')]
    assert "p =" not in Tags(therapist[therapist.index("<main>") :]).words


def test_speech_that_nobody_annotated_is_not_zero(tmp_path):
    page = report_of(one([turn(1, prompt_level=0)], [rating(1)]), tmp_path)
    assert "Nobody has annotated speech" in page


def test_study_page_holds_the_three_verdicts_and_the_smallest_p(tmp_path):
    words = Tags(report_of(made(children=4), tmp_path)).words
    for part in ("Difference: ", "Equivalence within ±20 percentage points, set beforehand", "2/70 = 0.0286",
                 "t(children − 2)", "4 triadic and 4 dyadic", "all 70 ways counted", "Excluded turns"):  # fmt: skip
        assert part in words


def test_two_against_two_gets_pictures_only(tmp_path):
    words = Tags(report_of(made(children=2), tmp_path)).words
    assert "Too few children to say: with fewer than 3 a group there are pictures only." in words
    assert "p =" not in words


def test_scores_that_nobody_confirmed_make_a_study_provisional(tmp_path):
    assert "Provisional:" in report_of(made(children=3, rated=0.5), tmp_path)


def test_agreement_without_a_number_has_words(tmp_path):
    turns = [turn(i, prompt_level=0) for i in range(1, 21)]
    ratings = [rating(i, r) for i in range(1, 21) for r in ("R1", "R2")]
    words = Tags(report_of(one(turns, ratings), tmp_path)).words
    assert "not defined: 20 of 20 agree" in words
    assert "nan" not in words.lower().split()


def test_single_case_graph_draws_no_line_across_a_phase(tmp_path):
    page = report_of(made(design="single_case", children=2, sessions=8), tmp_path)
    figure = page[page.index('<figure class="case">') :]
    figure = figure[: figure.index("</figure>")]
    assert figure.count('class="phase-line"') == 2
    ends = [
        [float(p.split(",")[0]) for p in points.split()] for points in re.findall(r'<polyline points="([^"]*)"', figure)
    ]
    borders = [float(x) for x in re.findall(r'<line x1="([\d.]+)"[^>]*class="phase-line"', figure)]
    for border, lines in zip(borders, (ends[:2], ends[2:]), strict=True):
        assert lines[0][-1] < border < lines[1][0]


def test_tables_go_with_the_page_and_films_are_found_from_there(tmp_path):
    report_of(made(design="single_case", children=2, sessions=8), tmp_path)
    out = tmp_path / "out"
    turns = pq.read_table(out / "turns.parquet")
    assert set(turns["film"].to_pylist()) >= {"../study/S01/film.mp4"}
    assert pq.read_table(out / "children.parquet").num_rows > 0
    assert pq.read_table(out / "points.parquet")["share"].to_pylist()
    assert (out / "ratings.csv").exists()


def test_an_older_report_is_replaced_and_nothing_else_is(tmp_path):
    report_of(made(children=3), tmp_path)
    write_report(gather([tmp_path / "study"]), tmp_path / "out")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("x")
    with pytest.raises(EpisodeError, match="holds other files"):
        write_report(gather([tmp_path / "study"]), tmp_path / "mine")
    with pytest.raises(GameError, match="holds the sessions themselves"):
        write_report(gather([tmp_path / "study"]), tmp_path / "study")


def test_every_session_has_a_page_when_asked(tmp_path):
    tables = with_settings(made(children=3, sessions=2))
    page = report_of(tables, tmp_path, every_session=True)
    assert page.count('class="page child') == 12


def test_films_of_any_name_stay_inside_a_relative_address(tmp_path):
    link = film_link(tmp_path / "out", tmp_path / "S 1", 'javascript:alert("1")#x?.mp4', 3.0)
    assert link == "../S%201/javascript%3Aalert%28%221%22%29%23x%3F.mp4#t=3.0".replace('"', "%22")


def test_command_answers_in_json(tmp_path, monkeypatch):
    store(made(children=4), tmp_path / "study")
    monkeypatch.chdir(tmp_path)
    done = CliRunner().invoke(_app(["report", "check"]), ["report", "study", "--json"])
    assert done.exit_code == 0, done.output
    answer = json.loads(done.output)
    assert answer["studies"][0]["ways"] == 70
    assert len(answer["children"]) == 8
