import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from sklearn.metrics import cohen_kappa_score

from nao_sim.game.agreement import cohen_kappa, nominal_alpha, pair_agreement, panel_of
from tests.game.test_tables import rating, turn

_ = None
FOUR_OBSERVERS = (  # Krippendorff's textbook example with gaps
    (1, 2, 3, 3, 2, 1, 4, 1, 2, _, _, _),
    (1, 2, 3, 3, 2, 2, 4, 1, 2, 5, _, 3),
    (_, 3, 3, 3, 2, 3, 4, 2, 2, 5, 1, _),
    (1, 2, 3, 3, 2, 4, 4, 1, 2, 5, 1, _),
)
TWO_OBSERVERS = ((0, 1, 0, 0, 0, 0, 0, 0, 1, 0), (1, 1, 1, 0, 0, 1, 0, 0, 0, 0))


@pytest.mark.parametrize(("observers", "alpha"), [(TWO_OBSERVERS, 0.095), (FOUR_OBSERVERS, 0.743)])
def test_published_alphas(observers, alpha):
    assert nominal_alpha(zip(*observers, strict=True)).value == pytest.approx(alpha, abs=5e-4)


@pytest.mark.parametrize("weights", ["none", "linear", "quadratic"])
@given(st.lists(st.tuples(st.integers(0, 2), st.integers(0, 2)), min_size=2, max_size=30))
@settings(max_examples=30, deadline=None)
def test_kappa_is_that_of_scikit_learn_where_that_is_a_number(weights, pairs):
    a, b = zip(*pairs, strict=True)
    table = np.zeros((3, 3), int)
    np.add.at(table, (a, b), 1)
    mine = cohen_kappa(table, weights)
    if len({*a, *b}) == 1:
        assert mine.value is None
        assert mine.words == f"not defined: {len(a)} of {len(a)} agree"
    else:
        name = None if weights == "none" else weights
        assert mine.value == pytest.approx(cohen_kappa_score(a, b, labels=[0, 1, 2], weights=name))


def test_all_equal_has_words_and_no_number():
    same = {f"S1/{i}": 1 for i in range(20)}
    pair = pair_agreement(("R1", same), ("R2", same), (0, 1))
    assert pair.kappas[0].words == "not defined: 20 of 20 agree"
    assert nominal_alpha([(1, 1)] * 20).words == "not defined: 20 of 20 agree"
    assert pair.percent == "20 of 20 (100 %)"


def test_always_opposite_is_defined():
    assert cohen_kappa(np.array([[0, 10], [0, 0]])).value == pytest.approx(0.0)


def test_rated_once_only_says_so():
    assert nominal_alpha([(1, None), (None, 0)]).words == "not defined: nothing was rated twice"


def test_printed_table_of_an_automatic_score_is_hardly_agreement():
    """DREAM D2.2.2: r = .79 over children, yet of 690 trials 243 + 94 agree."""
    assert cohen_kappa(np.array([[243, 76], [277, 94]])).value == pytest.approx(0.014, abs=5e-4)


def test_agreement_goes_by_turn_and_not_by_order_of_rating():
    a, b = {"x": 0, "y": 1, "z": 1}, {"z": 1, "y": 1, "w": 0, "x": 1}
    pair = pair_agreement(("A", a), ("B", b), (0, 1))
    assert pair.table == ((0, 1), (0, 2))
    assert (pair.agree, pair.both, pair.only_first, pair.only_second) == (2, 3, 0, 1)
    assert pair.differ == ("x",)


def test_panel_keeps_the_proposal_apart_and_lists_no_trial_disputes():
    auto = {"auto_score": 1, "auto_rule": "same_class", "auto_scale": "0/1"}
    turns = [turn(1, **auto), turn(2, **auto), turn(3, **auto), turn(4, excluded="robot_fell", **auto)]
    ratings = [rating(1), rating(2, score=0), rating(1, "R2", 0), rating(3, "R1", None, excluded="child_left")]
    ratings += [rating(3, "R2", 1), rating(4, "R1", 1), rating(4, "R2", 1)]
    panel = panel_of(turns, ratings, "0/1")
    assert [(p.first, p.second, p.both) for p in panel.people] == [("R1", "R2", 1)]
    assert [(p.first, p.second) for p in panel.proposals] == [("auto", "R1"), ("auto", "R2")]
    assert panel.no_trial == ("S1/003",)
    assert (panel.coverage[0].twice, panel.coverage[0].trials) == (1, 3)


def _slices(ratings, length, step):
    """What each rater 'does' in every slice of time: the score while the turn lasts, else nothing."""
    state = ["-"] * round(length / step)
    for begin, end, score in ratings:
        state[round(begin / step) : round(end / step)] = [str(score)] * (round(end / step) - round(begin / step))
    return state


def test_kappa_of_time_slices_is_another_quantity():
    """20 turns of 3 s, one every 10 s, 11 scored alike: agreed silence makes a slice kappa high."""
    first = [1] * 12 + [0] * 8
    second = [1] * 7 + [0] * 5 + [1] * 4 + [0] * 4
    per_turn = cohen_kappa_score(first, second)
    assert per_turn < 0.1
    turns = [(10 * i, 10 * i + 3) for i in range(20)]
    a, b = (
        _slices([(s, e, v) for (s, e), v in zip(turns, scores, strict=True)], 200, 0.2) for scores in (first, second)
    )
    assert cohen_kappa_score(a, b) > 0.7
    table = np.zeros((2, 2), int)
    np.add.at(table, (first, second), 1)
    assert cohen_kappa(table).value == pytest.approx(per_turn)
