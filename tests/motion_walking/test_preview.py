"""Preview control, and the plan that is built on it."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.motion.limits import check
from nao_sim.motion.trajectory import Trajectory
from nao_sim.motion.walking.body import WalkingBody
from nao_sim.motion.walking.gait import walk_settings
from nao_sim.motion.walking.plan import WalkPlan, plan_walk
from nao_sim.motion.walking.preview import GRAVITY, cart_table, follow
from nao_sim.robot.joints import ACTUATED, joint_table

HEIGHT = 0.25
MODEL = cart_table(HEIGHT, 0.02, walk_settings().preview)


@pytest.fixture(scope="module")
def sideways() -> WalkPlan:
    return plan_walk(0.0, 0.20, 0.0)


def square_wave() -> np.ndarray:
    reference = np.zeros(300)
    for start in range(50, 250, 52):
        reference[start : start + 26], reference[start + 26 : start + 52] = 0.046, -0.046
    return reference[:, None]


def test_the_zero_moment_point_follows_a_square_wave() -> None:
    states, zmp = follow(MODEL, square_wave())
    error = np.abs(zmp - square_wave())[:, 0]
    assert np.median(error) < 1e-3
    # Only beside the jumps is it off: a jerk is finite.
    jumps = np.flatnonzero(np.abs(np.diff(square_wave()[:, 0])) > 0.01)
    near = np.min(np.abs(np.arange(300)[:, None] - jumps), axis=1) <= 4
    assert error[~near].max() < 0.005
    np.testing.assert_allclose(zmp, states[:, 0] - HEIGHT / GRAVITY * states[:, 2], atol=1e-12)


def test_the_mass_moves_before_the_reference_does() -> None:
    reference = np.zeros((200, 1))
    reference[100:] = 0.05
    states, _ = follow(MODEL, reference)
    assert states[:40, 0].max() < 1e-3
    assert states[95, 0, 0] > 0.005
    assert states[-1, 0, 0] == pytest.approx(0.05, abs=1e-3)


def test_preview_control_does_not_care_where_the_origin_is() -> None:
    states, zmp = follow(MODEL, square_wave())
    moved, zmp_moved = follow(MODEL, square_wave() + 3.0)
    np.testing.assert_allclose(moved[:, 0], states[:, 0] + 3.0, atol=1e-8)
    np.testing.assert_allclose(zmp_moved, zmp + 3.0, atol=1e-8)


def test_a_greater_height_sways_less() -> None:
    low = follow(cart_table(0.2, 0.02, walk_settings().preview), square_wave())[0]
    high = follow(cart_table(0.6, 0.02, walk_settings().preview), square_wave())[0]
    assert np.ptp(high[100:200, 0]) < np.ptp(low[100:200, 0])


def test_the_whole_body_makes_the_planned_zero_moment_point(sideways: WalkPlan) -> None:
    made = WalkingBody().zero_moment_point(sideways.targets, sideways.torso, sideways.heading)
    assert np.sqrt(np.mean((made - sideways.zmp) ** 2, axis=0)).max() < 0.004
    assert np.median(np.abs(made - sideways.zmp)) < 0.002


def test_the_zero_moment_point_stays_under_the_standing_foot(sideways: WalkPlan) -> None:
    for foot in (0, 1):
        alone = sideways.support[:, foot] == 1.0
        ankle = sideways.feet[alone, foot, :2]
        assert alone.any()
        assert np.abs(sideways.zmp[alone, 1] - ankle[:, 1]).max() < 0.02
        assert ((sideways.zmp[alone, 0] - ankle[:, 0]) > -0.03).all()
        assert ((sideways.zmp[alone, 0] - ankle[:, 0]) < 0.07).all()


def test_a_standing_foot_does_not_move_and_a_swinging_one_clears_the_floor(sideways: WalkPlan) -> None:
    for foot in (0, 1):
        swinging = ~np.isnan(sideways.swing[:, foot])
        standing = ~swinging[1:] & ~swinging[:-1]
        assert np.abs(np.diff(sideways.feet[:, foot], axis=0))[standing].max() == 0.0
        assert (sideways.feet[~swinging, foot, 2] == 0.0).all()
        moving = np.abs(np.diff(sideways.feet[:, foot, 1], prepend=sideways.feet[0, foot, 1])) > 0.001
        assert (sideways.feet[moving, foot, 2] > 0.004).all()
        assert sideways.feet[:, foot, 2].max() == pytest.approx(walk_settings().gait.foot_lift_m, rel=0.02)
    assert (np.isnan(sideways.swing).any(axis=1)).all()  # never both in the air


def test_a_plan_starts_and_ends_in_stand_init(sideways: WalkPlan) -> None:
    stance = WalkingBody().targets
    np.testing.assert_allclose(sideways.targets[0], stance, atol=2e-3)
    np.testing.assert_allclose(sideways.targets[-1], stance, atol=1e-2)


@pytest.mark.parametrize(
    "goal", [(0.3, 0.0, 0.0), (-0.3, 0.0, 0.0), (0.0, -0.2, 0.0), (0.0, 0.0, 1.0), (0.2, 0.1, 0.5)]
)
def test_a_plan_keeps_ranges_and_nominal_speeds(goal: tuple[float, float, float]) -> None:
    plan = plan_walk(*goal)
    check(Trajectory(plan.times, plan.targets), "thesis")
    check(Trajectory(plan.times, plan.targets), "v5")
    # With room for the feedback.
    speed = np.abs(np.diff(plan.targets, axis=0)).max(axis=0) / 0.02
    assert (speed / joint_table().select(ACTUATED).max_speed_rad()).max() < 0.9
