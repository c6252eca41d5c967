"""Every place where a motion leaves ranges or outruns motors, and nothing else."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.gestures import Gesture, KeyFrame, written
from nao_sim.gestures.lead_in import lacking_s
from nao_sim.motion import check
from nao_sim.motion.curves import Curve
from nao_sim.motion.limits import asked_over_able
from nao_sim.motion.violations import violations
from nao_sim.robot import ACTUATED, LIMITS, SOFTNESS_RAD, UnknownNameError, joint_table

TABLE = joint_table()
JOINTS = [name for name in ACTUATED if not name.endswith("Hand")]


def curve(*pairs):
    return Curve(*np.array(pairs, dtype=float).T)


def test_a_line_has_joint_time_value_both_bounds_and_the_set_that_would_allow_it():
    found = violations({"LShoulderRoll": curve((0, 0.1), (1, -0.14), (2, -0.15), (3, 0.1))}, "thesis")
    assert [str(entry) for entry in found] == [
        "LShoulderRoll at 2.00 s (1.00 to 2.00 s) is -8.59, 8.6 beyond its 'thesis' range 0.00 .. 95.00 deg; "
        "'v5' allows it"
    ]
    assert violations({"LShoulderRoll": curve((1, -0.14))}, "v5") == []
    with pytest.raises(UnknownNameError, match="limit set 'v6'"):
        violations({"LShoulderRoll": curve((1, -0.14))}, "v6")


@settings(max_examples=60, deadline=None)
@given(
    joint=st.sampled_from(JOINTS),
    limits=st.sampled_from(LIMITS),
    past=st.floats(-0.1, 0.1),
    upper=st.booleans(),
)
def test_a_range_is_left_by_more_than_the_joints_own_softness(joint, limits, past, upper):
    bound = TABLE.select([joint]).range_rad(limits)[0][int(upper)]
    value = bound + past if upper else bound - past
    found = violations({joint: curve((1, value))}, limits)
    assert bool(found) == (past > SOFTNESS_RAD)
    for entry in found:
        shown = str(entry)
        assert f"'{limits}'" in shown
        assert np.deg2rad(entry.bounds[int(upper)]) == pytest.approx(bound)
        for other in entry.allowed_by:
            assert violations({joint: curve((1, value))}, other) == []


@settings(max_examples=40, deadline=None)
@given(phase=st.floats(0, 0.02), width=st.floats(0.001, 0.02), size=st.floats(0.5, 1.5), back=st.booleans())
def test_a_step_is_a_step_wherever_it_lies_between_set_points(phase, width, size, back):
    at = 1 + phase
    pairs = [(0, 0), (at, 0), (at + width, size), *([(at + 2 * width, 0)] if back else []), (3, 0 if back else size)]
    (found, *_) = violations({"HeadYaw": curve(*pairs)})
    assert found.unit == "deg/s"
    assert found.value >= np.rad2deg(size) / 0.02 * 0.99
    assert "steps by" in str(found)
    assert at - 0.02 - 1e-6 <= found.from_s <= at + 2 * width


@settings(max_examples=40, deadline=None)
@given(speed=st.floats(0.1, 2.0), spacing=st.sampled_from([0.01, 0.013, 0.04, 0.5]))
def test_even_movements_are_judged_by_their_speed_however_they_are_sampled(speed, spacing):
    most = TABLE["HeadYaw"].nominal_speed
    times = np.arange(0, 0.4 + spacing, spacing)
    found = violations({"HeadYaw": Curve(times, -0.8 + speed * most * (times - times[-1] / 2) / 4)})
    assert found == []
    found = violations({"HeadYaw": Curve(times, speed * most * times / 3)})
    assert not any(entry.unit == "deg/s" for entry in found)
    quick = violations({"HeadYaw": Curve(times / 10, np.clip(speed * most * times, -2, 2))})
    assert any(entry.unit == "deg/s" for entry in quick) == (speed > 0.1001 or speed * 10 > 1.0001)


@settings(max_examples=20, deadline=None)
@given(
    pose=st.dictionaries(st.sampled_from([name for name in JOINTS if "Hip" not in name]), st.floats(0, 1), min_size=1),
    first=st.sampled_from([0.0, 0.02, 0.04, 0.2, 0.5, 1.0]),
    easing=st.sampled_from(["linear", "cubic", "minimum_jerk"]),
)
def test_the_way_to_the_first_pose_is_never_blamed(pose, first, easing):
    ranges = dict(zip(TABLE.names, TABLE.range_rad("envelope"), strict=True))
    angles = {name: float(ranges[name][0] + share * np.ptp(ranges[name])) for name, share in pose.items()}
    frames = (KeyFrame(first, angles), KeyFrame(first + 0.5, angles))
    gesture = Gesture("own", None, "own", "linear", "none", "own", "own", frames, easing)
    trajectory = written(gesture)
    check(trajectory, "envelope")
    assert asked_over_able(trajectory).max() <= 1.0 + 1e-6
    assert lacking_s(list(frames), trajectory) == 0 or trajectory.duration > first + 0.5
