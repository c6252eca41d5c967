import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from nao_sim.motion import MotionError, RangeExceeded, SpeedExceeded, Trajectory, check, fit, joined
from nao_sim.motion.limits import bounds
from nao_sim.robot import ACTUATED, posture

HOME = np.array([posture("StandInit")[name] for name in ACTUATED])
YAW = ACTUATED.index("HeadYaw")


def still(times):
    return Trajectory(np.array(times), np.tile(HOME, (len(times), 1)))


def turning(angle_rad, seconds):
    targets = np.tile(HOME, (2, 1))
    targets[1, YAW] = angle_rad
    return Trajectory(np.array([0.0, seconds]), targets)


def test_samples_are_linear_between_and_held_outside():
    motion = turning(1.0, 2.0)
    assert motion.sample(1.0)[YAW] == pytest.approx(0.5)
    assert motion.sample(np.array([-1.0, 5.0]))[:, YAW] == pytest.approx([0.0, 1.0])
    assert motion.duration == 2.0
    assert motion.speeds()[0, YAW] == pytest.approx(0.5)


def test_arrays_are_read_only():
    motion = still([0.0, 1.0])
    with pytest.raises(ValueError, match="read-only"):
        motion.targets[0, 0] = 1.0


@pytest.mark.parametrize("times", [[0.0, 0.0], [0.0, 1.0, 0.5]])
def test_times_must_increase(times):
    with pytest.raises(MotionError, match="must increase"):
        still(times)


def test_shapes_and_numbers_are_checked():
    with pytest.raises(MotionError, match="want"):
        Trajectory(np.zeros(2), np.zeros((2, 24)))
    with pytest.raises(MotionError, match="finite"):
        Trajectory(np.zeros(1), np.full((1, 25), np.nan))


def test_joined_parts_follow_each_other():
    both = joined(turning(1.0, 1.0), still([0.0, 1.0]))
    assert both.duration == pytest.approx(2.02)
    assert both.sample(1.0)[YAW] == pytest.approx(1.0)


def test_range_error_names_joint_time_and_bound():
    with pytest.raises(RangeExceeded, match=r"HeadYaw is asked for 171.89 deg at 2.00 s.*-120.00 .. 120.00 deg"):
        check(turning(3.0, 2.0))


def test_speed_error_names_joint_time_and_bound():
    with pytest.raises(SpeedExceeded, match=r"HeadYaw is asked for 1145.9 deg/s at 0.00 s, its motor does 351.8"):
        check(turning(2.0, 0.1))


def test_v5_is_stricter_about_the_shoulder():
    targets = np.tile(HOME, (2, 1))
    targets[1, ACTUATED.index("LShoulderRoll")] = np.deg2rad(90)
    motion = Trajectory(np.array([0.0, 2.0]), targets)
    check(motion, "thesis")
    with pytest.raises(RangeExceeded, match="LShoulderRoll"):
        check(motion, "v5")


def test_fit_reports_what_it_changed_and_leaves_the_rest():
    fitted, changes = fit(turning(3.0, 0.3))
    check(fitted)
    assert {change.what for change in changes} == {"angle", "speed"}
    assert {change.joint for change in changes} == {"HeadYaw"}
    others = [index for index in range(len(ACTUATED)) if index != YAW]
    assert np.allclose(fitted.targets[:, others], HOME[others])


def test_fit_changes_nothing_that_fits():
    slow = turning(1.0, 2.0)
    fitted, changes = fit(slow)
    assert changes == []
    assert np.allclose(fitted.sample(slow.times), slow.targets)


@settings(deadline=None, max_examples=25)
@given(
    targets=hnp.arrays(float, (6, len(ACTUATED)), elements=st.floats(-3.0, 3.0, allow_subnormal=False)),
    gaps=st.lists(st.floats(0.02, 0.5), min_size=6, max_size=6),
)
def test_anything_can_be_fitted(targets, gaps):
    fitted, _ = fit(Trajectory(np.cumsum(gaps), targets))
    check(fitted)
    inside = np.clip(targets, *bounds().range_rad.T)
    assert np.allclose(fitted.targets[0], inside[0])
    assert np.allclose(fitted.targets[-1], inside[-1])
