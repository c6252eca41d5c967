"""What was measured, rounded or printed can be commanded again; what is further out is refused in words that tell."""

from __future__ import annotations

import doctest
import re

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.robot import ACTUATED, LIMITS, AngleRangeError, Nao, joint_table, tolerance
from nao_sim.robot.command import CommandLayer
from nao_sim.robot.tolerance import SOFTNESS_RAD, on_limits, sets_allowing, tell_apart

SETS = st.sampled_from(LIMITS)
SHARES = st.lists(st.one_of(st.just(0.0), st.just(1.0), st.floats(0, 1)), min_size=25, max_size=25).map(np.array)
PAST = st.lists(st.floats(-SOFTNESS_RAD, SOFTNESS_RAD), min_size=25, max_size=25).map(np.array)


@settings(max_examples=60, deadline=None)
@given(SETS, SHARES, PAST)
def test_whatever_a_soft_joint_measures_is_taken_and_ends_inside(
    limits: str, share: np.ndarray, past: np.ndarray
) -> None:
    low, high = joint_table().select(ACTUATED).range_rad(limits).T
    measured = np.clip(low + share * (high - low) + past, low - 0.99 * SOFTNESS_RAD, high + 0.99 * SOFTNESS_RAD)
    command = CommandLayer(limits, 0.02)
    printed = np.array([float(f"{value:.6g}") for value in measured])
    in_degrees = np.deg2rad(np.array([float(f"{value:.5f}") for value in np.rad2deg(measured)]))
    for angles in (measured, measured.astype(np.float32), printed, in_degrees):
        command.set_all(angles)
        assert (command.targets >= low).all()
        assert (command.targets <= high).all()


@settings(max_examples=60, deadline=None)
@given(SETS, st.sampled_from(ACTUATED), st.booleans(), st.floats(1.02 * SOFTNESS_RAD, 2.0))
def test_further_out_is_refused_with_set_joint_value_bounds_and_mend(
    limits: str, joint: str, above: bool, past: float
) -> None:
    command = CommandLayer(limits, 0.02)
    row = ACTUATED.index(joint)
    before = command.targets
    asked = command.high[row] + past if above else command.low[row] - past
    with pytest.raises(AngleRangeError) as caught:
        command.set(joint, asked)
    assert command.targets is before
    text = str(caught.value)
    assert joint in text
    assert f"'{limits}'" in text
    value, low, high = map(float, re.findall(r"-?\d+\.\d+", text)[:3])
    assert value > high if above else value < low
    others = [name for name in sets_allowing(joint, asked) if name != limits]
    assert (f"'{others[0]}'" in text) if others else ("limits '" not in text.partition(";")[2])


def test_a_refusal_names_the_set_that_allows_it() -> None:
    with pytest.raises(AngleRangeError, match=r"RKneePitch: 2\.1600 .*of the limits 'v5'; stay inside, .*'thesis'"):
        CommandLayer("v5", 0.02).set("RKneePitch", 2.16)


@settings(max_examples=100, deadline=None)
@given(st.floats(-7, 7), st.floats(1e-8, 1.0))
def test_shown_numbers_are_as_far_apart_as_the_real_ones(bound: float, past: float) -> None:
    value = bound + past
    shown, limit = tell_apart(value, bound)
    assert float(shown) > float(limit)
    assert not {shown, limit} & {"-0.00", "-0.000"}


def test_what_is_no_number_is_left_for_the_caller_to_refuse() -> None:
    kept = on_limits([np.nan, np.inf, 0.5, 1.001, 1.1], 0.0, 1.0)
    assert np.isnan(kept[0])
    assert kept[1:].tolist() == [np.inf, 0.5, 1.0, 1.1]


def test_the_documented_example_is_true() -> None:
    assert doctest.testmod(tolerance).failed == 0


@pytest.mark.parametrize("posture", ["StandZero", "SitRelax", "LyingBack"])
def test_a_robot_holds_what_it_measures(posture: str, standing: Nao) -> None:
    standing.reset(posture)
    for _ in range(40):
        standing.step(3)
        standing.set_angles("JointActuators", standing.angles.astype(np.float32))


def test_sets_that_differ_stay_different() -> None:
    """The tolerance never makes one documented range pass for another."""
    thesis, v5 = joint_table().range_rad("thesis"), joint_table().range_rad("v5")
    apart = np.abs(thesis - v5)
    assert apart[apart > 0].min() > SOFTNESS_RAD
