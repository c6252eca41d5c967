from dataclasses import replace
from fractions import Fraction

import pytest

from nao_sim.game.errors import GameError
from nao_sim.game.study import child_cases, child_results, gather, study_results, trials_of
from nao_sim.game.study.fidelity import fidelity, order_kept
from nao_sim.game.tables import Event, Tables
from nao_sim.game.tables.schema import TABLES
from tests.game.studies import made, session_of, store, with_settings
from tests.game.test_tables import rating, session, turn


def one(turns, ratings=(), events=(), **settings):
    return Tables((session(**settings),), tuple(turns), tuple(ratings), tuple(events))


def test_success_with_help_is_no_independent_success_and_nothing_excluded_is_a_zero():
    turns = [turn(1, prompt_level=0), turn(2, prompt_level=2), turn(3, excluded="child_left"), turn(4, prompt_level=0)]
    ratings = [rating(1), rating(2), rating(4, score=0)]
    found = child_results(trials_of(one(turns, ratings)), "independent")[0]
    assert (found.total, found.counted, found.valid, found.successes) == (1, 3, 3, 2)
    assert found.excluded == {"child_left": 1}
    assert found.share == Fraction(1, 3)


def test_unknown_prompt_level_and_missing_scores_are_counted_apart():
    found = child_results(trials_of(one([turn(1), turn(2, prompt_level=0)], [rating(1)])), "independent")[0]
    assert (found.counted, found.unprompted, found.unscored) == (0, 1, 1)
    assert found.share is None


def test_turns_that_a_robot_or_therapist_imitates_are_no_trials():
    robot = turn(2, imitator="NAO", imitator_role="robot", model="007", model_role="child")
    assert [t.turn.turn for t in trials_of(one([turn(1), robot]))] == [1]


def test_mean_score_is_a_share_of_the_highest():
    turns = [turn(i, prompt_level=1) for i in (1, 2)]
    ratings = [rating(1, score=2, scale="0/1/2"), rating(2, score=1, scale="0/1/2")]
    tables = one(turns, ratings, scale="0/1/2", primary_outcome="mean_score", success_at=2)
    assert study_results(tables)[0].children[0].share == Fraction(3, 4)
    assert child_results(trials_of(tables), "success")[0].share == Fraction(1, 2)


def test_groups_compare_children_not_turns():
    result = study_results(made(children=4))[0]
    shares = {c: [r.share for r in result.of(c)] for c in ("triadic", "dyadic")}
    assert [len(s) for s in shares.values()] == [4, 4]
    assert result.comparison.ways == 70
    means = [sum(s) / 4 for s in shares.values()]
    assert result.comparison.difference == means[0] - means[1]


def test_below_three_a_group_there_is_no_p_anywhere():
    result = study_results(made(children=2))[0]
    assert result.comparison is None
    assert result.verdicts.different is None
    assert result.model == "too few children"


def test_crossover_pairs_children_and_names_those_with_one_condition():
    tables = made(design="crossover", children=6, sessions=1)
    lost = next(s.session for s in tables.sessions if s.condition == "dyadic")
    kept = [session_of(tables, s.session) for s in tables.sessions if s.session != lost]
    fewer = Tables(*(tuple(r for part in kept for r in getattr(part, name)) for name in TABLES))
    assert study_results(tables)[0].comparison.ways == 64
    result = study_results(fewer)[0]
    assert result.comparison.ways == 32
    assert any("only the triadic" in line for line in result.left_out)


@pytest.mark.parametrize("setting", [{"margin": 0.1}, {"primary_outcome": "success"}, {"rule": "same_family"}])
def test_nothing_is_tested_until_the_sessions_agree(setting):
    tables = made(children=3)
    odd = replace(tables.sessions[2], **setting)
    result = study_results(replace(tables, sessions=(*tables.sessions[:2], odd, *tables.sessions[3:])))[0]
    assert result.comparison is None
    assert result.verdicts is None
    assert any(name in result.obstacles[0] for name in setting)


def test_groups_whose_child_played_both_conditions_are_not_tested():
    tables = made(design="crossover", children=4, sessions=1)
    tables = replace(
        with_settings(tables, design="groups"), turns=tuple(replace(t, design="groups") for t in tables.turns)
    )
    result = study_results(tables)[0]
    assert result.comparison is None
    assert "crossover" in result.obstacles[0]


def test_single_cases_are_not_compared_as_groups():
    result = study_results(made(design="single_case", children=3, sessions=8))[0]
    assert result.comparison is None
    assert result.verdicts is None
    cases = child_cases(result.trials, "independent")
    assert [[p.name for p in c.phases] for c in cases] == [["baseline", "game"]] * 3
    assert cases[0].blocks == 0
    assert len(cases[0].pairs) == 1


def test_few_sessions_are_divided_into_blocks_and_a_small_rest_joins_the_last():
    turns = [turn(i, prompt_level=0, phase="baseline" if i < 6 else "game") for i in range(1, 18)]
    ratings = [rating(i) for i in range(1, 18)]
    case = child_cases(trials_of(one(turns, ratings, design="groups")), "independent", 5)[0]
    assert case.blocks == 5
    assert [[p.counted for p in phase.points] for phase in case.phases] == [[5], [5, 7]]


def test_fidelity_counts_only_what_a_turn_called_for():
    turns = [
        turn(1, instruction_s=1.0, model_end_s=2.0, latency_censored=True, waited_s=4.0, prompt_level=2),
        turn(2, model_end_s=2.0, praise_s=9.0, prompt_level=0, movement_start_s=3.0, latency_s=1.0),
        turn(3, excluded="aborted"),
    ]
    prompts = [Event("S1", "prompt", t, turn_id="S1/001", level=level) for t, level in ((5.0, 2), (6.0, 1))]
    tables = one(turns, [rating(1, score=0), rating(2)], prompts, timeout_s=8.0)
    steps = {s.name: (s.done, s.due, s.missed) for s in fidelity(trials_of(tables), tables.events)}
    assert steps["the instruction was given"] == (1, 2, ("S1/002",))
    assert steps["the time-out was waited for"] == (0, 1, ("S1/001",))
    assert steps["prompts went from least to most help"] == (0, 1, ("S1/001",))
    assert steps["a success in the game was praised"] == (1, 1, ())
    assert "nothing was praised in the baseline" not in steps


def test_order_is_compared_place_by_place():
    tables = one([turn(1), turn(2, target="stop")], planned=("bye_right", "yes", "no"))
    kept = order_kept(tables.sessions[0], trials_of(tables))
    assert (kept.planned, kept.played, kept.kept) == (3, 2, 1)


def test_sessions_are_found_below_a_folder_and_none_twice(tmp_path):
    store(made(children=3, sessions=1), tmp_path / "study")
    found = gather([tmp_path / "study", tmp_path / "study" / "S01"])
    assert len(found.tables.sessions) == 6
    store(made(children=3, sessions=1), tmp_path / "copy")
    with pytest.raises(GameError, match="stands in"):
        gather([tmp_path])
    with pytest.raises(GameError, match="does not exist"):
        gather([tmp_path / "nowhere"])


def test_a_made_up_study_comes_from_its_seed():
    assert made(seed=4) == made(seed=4)
    assert made(seed=4) != made(seed=5)
