from fractions import Fraction
from itertools import combinations, product
from math import comb

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import quad
from scipy.stats import binom, mannwhitneyu, norm

from nao_sim.game.statistics import (
    compare_groups,
    compare_pairs,
    exchanged_groups,
    fit_mixed_model,
    flipped_signs,
    nap,
    summarise_latency,
    theil_sen_slope,
    trend_tau,
    verdicts_of,
    wilson_interval,
)
from nao_sim.game.statistics.inversion import equivalence_p, shift_interval
from nao_sim.game.statistics.mixed_model import _minus_log_likelihood


def tenths(*values):
    return [Fraction(v, 10) for v in values]


def by_definition(first, second, shift=Fraction(0)):
    """Count every exchange of children one by one, in fractions; ``shift`` is taken from the first group."""
    pool = [v - shift for v in first] + list(second)
    n1, n2, total = len(first), len(second), sum(pool)
    of = [sum(pool[i] for i in chosen) for chosen in combinations(range(n1 + n2), n1)]
    differences = [s / n1 - (total - s) / n2 for s in of]
    return sum(abs(d) >= abs(differences[0]) for d in differences), len(differences)


def test_seven_against_seven_as_an_exact_fraction():
    first = [Fraction(k, 20) for k in (18, 15, 14, 6, 12, 4, 5)]
    second = [Fraction(k, 20) for k in (5, 2, 10, 6, 15, 0, 3)]
    assert by_definition(first, second) == (460, 3432)
    found = compare_groups(first, second)
    assert (found.extreme, found.ways) == (460, 3432)


def test_equal_differences_are_equal_whatever_floats_say():
    first, second = tenths(8, 4, 3, 2), tenths(3, 6, 0, 3)
    values = [float(v) for v in first + second]
    floats = [np.mean([values[i] for i in c]) - np.mean([values[i] for i in range(8) if i not in c])
              for c in combinations(range(8), 4)]  # fmt: skip
    assert sum(abs(f) >= abs(floats[0]) for f in floats) / 70 == pytest.approx(0.514, abs=5e-4)
    assert compare_groups(first, second).p == pytest.approx(0.600)


def test_published_one_sided_shares():
    """Rosetta Code's permutation test: 12.80 % of the ways differ more, 87.20 % at most as much."""
    ways = exchanged_groups(
        [Fraction(v) for v in (85, 88, 75, 66, 25, 29, 83, 39, 97)],
        [Fraction(v) for v in (68, 41, 10, 49, 16, 65, 32, 92, 28, 98)],
    )
    assert np.mean(ways.values > ways.observed) == pytest.approx(0.1280, abs=5e-5)


shares = st.builds(Fraction, st.integers(0, 12), st.integers(12, 14))


@given(st.lists(shares, min_size=3, max_size=4), st.lists(shares, min_size=3, max_size=5))
@settings(max_examples=40, deadline=None)
def test_p_is_the_count_by_definition(first, second):
    found = compare_groups(first, second)
    assert (found.extreme, found.ways) == by_definition(first, second)


def test_values_whose_common_denominator_leaves_64_bits_are_still_exact():
    primes = (1009, 1013, 1019, 1021, 1031, 1033, 1039, 1049)
    values = [Fraction(p // 2, p) for p in primes]
    found = compare_groups(values[:4], values[4:])
    assert (found.extreme, found.ways) == by_definition(values[:4], values[4:])


@given(st.lists(shares, min_size=4, max_size=4), st.lists(shares, min_size=4, max_size=4))
@settings(max_examples=15, deadline=None)
def test_interval_holds_exactly_the_differences_that_are_not_rejected(first, second):
    low, high = shift_interval(exchanged_groups(first, second), 0.9)
    inside = (Fraction(low).limit_denominator(10**9), Fraction(high).limit_denominator(10**9))
    for at in inside:
        extreme, ways = by_definition(first, second, at)
        assert extreme / ways > 0.1 or _near(first, second, at)
    for outside in (inside[0] - Fraction(1, 10**6), inside[1] + Fraction(1, 10**6)):
        extreme, ways = by_definition(first, second, outside)
        assert extreme / ways <= 0.1


def _near(first, second, at):
    """An end of the interval is rounded; a hair inside it p must be above the level."""
    hair = Fraction(1, 10**7)
    return any(by_definition(first, second, at + d)[0] / 70 > 0.1 for d in (hair, -hair))


@given(st.lists(st.builds(Fraction, st.integers(-9, 9), st.just(10)), min_size=3, max_size=6))
@settings(max_examples=40, deadline=None)
def test_sign_flips_count_by_definition(differences):
    sums = [
        sum(s * d for s, d in zip(signs, differences, strict=True))
        for signs in product((1, -1), repeat=len(differences))
    ]
    found = compare_pairs(differences)
    assert (found.extreme, found.ways) == (sum(abs(s) >= abs(sum(differences)) for s in sums), 2 ** len(differences))


@pytest.mark.parametrize(("children", "p"), [(3, 0.100), (4, 0.029), (5, 0.0079)])
def test_smallest_p_of_two_groups(children, p):
    found = compare_groups(tenths(*[9] * children), tenths(*[1] * children))
    assert found.p == found.smallest_p == pytest.approx(p, abs=5e-4)


@pytest.mark.parametrize(("children", "p"), [(5, 0.0625), (6, 0.03125)])
def test_smallest_p_of_a_crossover(children, p):
    assert compare_pairs(tenths(*range(1, children + 1))).p == p


def test_unequal_groups_count_differences_by_size():
    found = compare_groups(tenths(8, 9, 10), tenths(*[1, 2, 3, 1, 2, 3, 4, 2]))
    assert (found.extreme, found.ways) == (1, comb(11, 3))
    assert found.smallest_p == 1 / 165


def test_children_change_groups_only_within_their_stratum():
    first, second = tenths(9, 8, 3, 2), tenths(7, 6, 1, 0)
    strata = (["a", "a", "b", "b"], ["a", "a", "b", "b"])
    ways = exchanged_groups(first, second, strata)
    assert ways.ways == 36
    by_hand = []
    for a in combinations((9, 8, 7, 6), 2):
        for b in combinations((3, 2, 1, 0), 2):
            by_hand.append(2 * (sum(a) + sum(b)) - 36)
    assert ways.extreme == sum(abs(v) >= abs(2 * 22 - 36) for v in by_hand)


def test_many_children_are_sampled_reproducibly_and_never_p_0():
    first, second = tenths(*[10] * 12), tenths(*[0] * 12)
    found = compare_groups(first, second)
    assert not found.exact
    assert found.p == 1 / 20_001
    assert compare_groups(first, second) == found


def test_below_three_against_three_there_is_no_number():
    assert compare_groups(tenths(9, 8), tenths(1, 2, 3)) is None
    verdicts = verdicts_of(None)
    assert verdicts.too_few
    assert verdicts.different is None
    assert "p" not in verdicts.sentences[0].split()


def test_three_verdicts_are_separate():
    shown = verdicts_of(compare_groups(tenths(9, 9, 8, 10), tenths(1, 2, 3, 2), 0.1))
    assert (shown.different, shown.equivalent, shown.too_few) == (True, False, False)
    alike = tenths(50, 51, 52, 53, 54)
    small = [v / 10 for v in alike]
    same = verdicts_of(compare_groups(small, small, 0.2))
    assert (same.different, same.equivalent, same.too_few) == (False, True, False)
    few = verdicts_of(compare_groups(tenths(9, 9, 9), tenths(1, 1, 1), 0.2))
    assert (few.different, few.equivalent, few.too_few) == (False, False, True)
    unasked = verdicts_of(compare_groups(tenths(9, 1, 5, 4), tenths(4, 5, 2, 8)))
    assert unasked.equivalent is None
    assert "not the same as no difference" in unasked.sentences[0]


def test_design_that_rejects_nothing_has_no_interval():
    assert compare_groups(tenths(9, 9, 9), tenths(1, 1, 1)).interval is None


def test_equivalence_is_two_one_sided_tests():
    first, second, margin = tenths(5, 6, 7, 5), tenths(6, 6, 5, 4), Fraction(3, 10)
    pool = first + second

    def one_sided(shift, sign):
        values = [v - shift for v in first] + second
        got = [sign * (sum(values[i] for i in c) * 2 - sum(values)) for c in combinations(range(len(pool)), 4)]
        return sum(g >= got[0] for g in got) / len(got)

    expected = max(one_sided(-margin, 1), one_sided(margin, -1))
    assert equivalence_p(exchanged_groups(first, second), 0.3) == pytest.approx(expected)


def test_wilson():
    assert wilson_interval(0, 20) == (0.0, pytest.approx(0.161, abs=5e-4))
    assert wilson_interval(20, 20) == (pytest.approx(0.839, abs=5e-4), 1.0)
    assert wilson_interval(8, 10) == (pytest.approx(0.490, abs=5e-4), pytest.approx(0.943, abs=5e-4))


def test_likelihood_of_the_mixed_model_is_the_integral():
    k, n, x = np.array([3.0, 9, 14]), np.array([10.0, 20, 15]), np.array([1.0, 0, 1])
    b = np.array([0.3, -0.5, 1.2])

    def child(i):
        def density(u):
            return binom.pmf(k[i], n[i], 1 / (1 + np.exp(-(b[0] + b[1] * x[i] + u)))) * norm.pdf(u, scale=b[2])

        return np.log(quad(density, -12, 12, epsabs=1e-14)[0]) - np.log(comb(int(n[i]), int(k[i])))

    assert -_minus_log_likelihood(b, k, n, x)[0] == pytest.approx(sum(child(i) for i in range(3)), abs=1e-5)


def test_mixed_model_without_spread_is_plain_logistic_regression():
    k, n, first = np.full(8, 10), np.full(8, 20), np.arange(8) < 4
    k[:4] = 14
    model = fit_mixed_model(k, n, first)
    assert model.child_sd == pytest.approx(0, abs=1e-3)
    assert model.log_odds_ratio == pytest.approx(np.log(14 / 6), abs=1e-4)
    assert model.standard_error == pytest.approx(np.sqrt(1 / 56 + 1 / 24 + 1 / 40 + 1 / 40), rel=1e-3)
    assert model.freedom == 6


def test_mixed_model_says_why_there_is_none():
    assert "one result" in fit_mixed_model(np.array([5, 5, 1, 2]), np.full(4, 5), np.array([1, 1, 0, 0]))
    assert fit_mixed_model(np.array([1, 1]), np.array([2, 2]), np.array([1, 0])) == "too few children"


points = st.lists(st.builds(Fraction, st.integers(0, 6), st.just(6)), min_size=1, max_size=8)


@given(points, points)
@settings(max_examples=40, deadline=None)
def test_nap_is_mann_whitney(baseline, game):
    u = mannwhitneyu([float(g) for g in game], [float(b) for b in baseline]).statistic
    assert float(nap(baseline, game)) == pytest.approx(u / (len(baseline) * len(game)))


def test_a_baseline_that_only_rises_is_seen():
    rise = tenths(1, 2, 3, 4, 5)
    assert nap(rise, tenths(6, 7, 8, 9, 10)) == 1
    assert trend_tau(rise) == 1
    assert theil_sen_slope(rise) == Fraction(1, 10)


def test_one_outlier_does_not_make_nap_nothing():
    assert nap(tenths(1, 1, 1, 1, 10), tenths(8, 8, 8)) == Fraction(4, 5)


def test_waits_without_an_answer_lengthen_the_median_and_are_no_numbers():
    assert summarise_latency([1.0, 2.0, 3.0], []).median_s == 2.0
    with_waits = summarise_latency([1.0, 2.0, 3.0], [8.0, 8.0])
    assert (with_waits.median_s, with_waits.longest_s, with_waits.censored) == (3.0, 3.0, 2)
    assert summarise_latency([1.0], [8.0, 8.0]).median_s is None


def test_flips_are_all_or_a_sample():
    assert flipped_signs(tenths(*[1] * 17)).exact
    assert not flipped_signs(tenths(*[1] * 18)).exact
