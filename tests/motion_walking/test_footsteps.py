"""Footsteps: where they lead, how long they are, and that feet keep out of each other's way."""

from __future__ import annotations

import numpy as np
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.linalg import expm, logm

from nao_sim.motion.walking.footsteps import along_twist, beside, footsteps
from nao_sim.motion.walking.gait import walk_settings

GAIT = walk_settings().gait
goals = st.tuples(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4), st.floats(-2, 2))


def pose_matrix(x: float, y: float, turn: float) -> np.ndarray:
    c, s = np.cos(turn), np.sin(turn)
    return np.array([[c, -s, x], [s, c, y], [0, 0, 1]])


@settings(max_examples=15, deadline=None)
@given(goal=goals, share=st.floats(0.05, 1))
def test_the_way_is_a_constant_twist(goal, share) -> None:
    x, y, heading = along_twist(*goal, share)
    np.testing.assert_allclose(pose_matrix(x, y, heading), expm(share * np.real(logm(pose_matrix(*goal)))), atol=1e-6)


@settings(max_examples=15, deadline=None)
@given(goal=goals)
def test_the_last_two_steps_stand_at_the_goal(goal) -> None:
    steps = footsteps(*goal, GAIT)
    if not steps:
        assert np.allclose(goal, 0, atol=1e-5)
        return
    assert {steps[-1].foot, steps[-2].foot} == {0, 1}
    for step in steps[-2:]:
        there = beside(np.array(goal), step.foot, GAIT)
        np.testing.assert_allclose([step.x, step.y, step.heading], [there.x, there.y, there.heading], atol=1e-9)


@settings(max_examples=15, deadline=None)
@given(goal=goals)
def test_feet_alternate_and_keep_apart(goal) -> None:
    steps = footsteps(*goal, GAIT)
    feet = [beside(np.zeros(3), foot, GAIT) for foot in (0, 1)]
    for before, step in zip([None, *steps], steps, strict=False):
        assert before is None or step.foot != before.foot
        feet[step.foot] = step
        apart = np.linalg.norm(polygon(feet[0])[:, None] - polygon(feet[1])[None], axis=-1).min()
        assert apart > GAIT.clearance_m - 1e-6
        standing = feet[1 - step.foot]
        c, s = np.cos(standing.heading), np.sin(standing.heading)
        dx, dy = step.x - standing.x, step.y - standing.y
        assert abs(c * dx + s * dy) <= GAIT.most_forward_m + 0.02
        assert abs(-s * dx + c * dy) <= GAIT.stance_width_m + GAIT.most_sideways_m + 1e-9


def polygon(foot) -> np.ndarray:
    """Return points all over a sole, in the plan's frame."""
    grid = np.stack(np.meshgrid(np.linspace(-0.0507, 0.0994, 13), np.linspace(-0.0358, 0.047, 8)), -1).reshape(-1, 2)
    c, s = np.cos(foot.heading), np.sin(foot.heading)
    return grid * [1, 1 if foot.foot == 0 else -1] @ np.array([[c, s], [-s, c]]) + [foot.x, foot.y]


def test_walking_to_the_left_starts_with_the_left_foot_and_never_crosses() -> None:
    steps = footsteps(0.0, 0.35, 0.0, GAIT)
    assert steps[0].foot == 0
    assert len(steps) == 2 * np.ceil(0.35 / GAIT.most_sideways_m)
    assert (np.diff([step.y for step in steps if step.foot == 0]) > 0.04).all()
    assert footsteps(0.0, -0.35, 0.0, GAIT)[0].foot == 1


def test_nowhere_takes_no_step() -> None:
    assert footsteps(0.0, 0.0, 0.0, GAIT) == []
