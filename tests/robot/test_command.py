"""The command layer: ranges, anti-collision tables, speed."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.robot import ACTUATED, AngleRangeError, Nao, TargetError, UnknownNameError, joint_table, postures
from nao_sim.robot.anti_collision import clamp_pairs, pair_tables
from nao_sim.robot.command import CommandLayer
from nao_sim.robot.joints import BODY

TABLE = joint_table().select(ACTUATED)
LOW, HIGH = TABLE.range_rad().T
FRACTIONS = st.lists(st.floats(0, 1), min_size=25, max_size=25).map(np.array)


def _inside_tables(angles: np.ndarray, slack: float = 1e-9) -> bool:
    for table in pair_tables():
        low, high = table.range_at(angles[ACTUATED.index(table.given)])
        if not low - slack <= angles[ACTUATED.index(table.limits)] <= high + slack:
            return False
    return True


def test_head_table_at_its_rows_and_between() -> None:
    head = pair_tables()[0]
    assert np.degrees(head.range_at(np.radians(27.85))) == pytest.approx([-38.5, 24.18])
    assert np.degrees(head.range_at(np.radians(-13.925))) == pytest.approx([-38.5, (29.51 + 24.18) / 2])
    assert np.degrees(head.range_at(np.radians(120))) == pytest.approx([-25.73, 18.91])
    assert np.degrees(head.range_at(np.radians(-120))) == pytest.approx([-25.73, 18.91])


def test_ankle_tables_mirror() -> None:
    left, right = (t for t in pair_tables() if t.limits.endswith("AnkleRoll"))
    for pitch in np.radians([-70, -44, -10, 15, 50]):
        low, high = left.range_at(pitch)
        assert right.range_at(pitch) == pytest.approx((-high, -low))


def test_official_postures_satisfy_the_tables() -> None:
    for wanted in postures().values():
        angles = np.array([wanted[name] for name in ACTUATED])
        assert np.degrees(np.abs(clamp_pairs(angles) - angles)).max() < 0.02, wanted.name


def test_a_nod_at_the_side_is_cut_by_the_table(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles("Head", np.radians([60.0, 29.0]))
    assert np.degrees(hung.targets[1]) == pytest.approx(17.19 + (60 - 62.45) / (51.74 - 62.45) * (18.91 - 17.19))


@settings(max_examples=60, deadline=None)
@given(FRACTIONS, FRACTIONS)
def test_setpoints_stay_inside_ranges_tables_and_speed(start: np.ndarray, goal: np.ndarray) -> None:
    command = CommandLayer("thesis", 0.02)
    command.reset(LOW + start * (HIGH - LOW))
    command.set_all(LOW + goal * (HIGH - LOW))
    before = command.setpoint
    step = TABLE.max_speed_rad() * 0.02
    for _ in range(150):
        setpoint = command.advance()
        assert (setpoint >= LOW).all()
        assert (setpoint <= HIGH).all()
        assert (np.abs(setpoint - before) <= step + 1e-12).all()
        assert _inside_tables(setpoint)
        before = setpoint
    assert before == pytest.approx(command.targets, abs=1e-9)


def test_a_chain_takes_one_value_or_one_each(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles("Head", 0.1)
    assert hung.targets[:2] == pytest.approx([0.1, 0.1])
    hung.set_angles(["HeadYaw", "RHand"], [-0.2, 1.0])
    assert hung.targets[[0, 24]] == pytest.approx([-0.2, 1.0])


def test_one_motor_turns_both_hip_yaw_pitch_joints(hung: Nao) -> None:
    row = ACTUATED.index("LHipYawPitch")
    hung.reset("StandZero")
    hung.set_angles("RHipYawPitch", -0.3)
    assert hung.targets[row] == pytest.approx(-0.3)
    hung.set_angles(["RHipYawPitch", "LHipYawPitch"], [-0.1, -0.2])
    assert hung.targets[row] == pytest.approx(-0.2)
    body = np.array([postures()["Stand"][name] for name in BODY])
    hung.set_angles("Body", np.clip(body, *joint_table().range_rad().T))
    hung.step(60)
    joints = hung.data.joint
    assert joints("RHipYawPitch").qpos[0] == pytest.approx(joints("LHipYawPitch").qpos[0], abs=0.003)


def test_an_angle_out_of_range_is_refused_with_joint_value_and_bounds(hung: Nao) -> None:
    hung.reset("StandZero")
    before = hung.targets
    with pytest.raises(AngleRangeError, match=r"LElbowRoll: 0\.5000 is outside \[-1\.5708, 0\.0000\] rad") as caught:
        hung.set_angles(["HeadYaw", "LElbowRoll"], [0.3, 0.5])
    assert (caught.value.joint, caught.value.value_rad) == ("LElbowRoll", 0.5)
    assert (hung.targets == before).all()
    with pytest.raises(AngleRangeError, match=r"LHand: 1\.5000 .*open fraction"):
        hung.set_angles("LHand", 1.5)


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_not_a_number_is_refused(bad: float, hung: Nao) -> None:
    with pytest.raises(TargetError, match="HeadPitch: the target is not a finite number"):
        hung.set_angles("HeadPitch", bad)


def test_wrong_counts_and_names_are_refused(hung: Nao) -> None:
    with pytest.raises(TargetError, match="3 angles for 2 joints"):
        hung.set_angles("Head", [0, 0, 0])
    with pytest.raises(TargetError, match=r"\(24,\)"):
        hung.set_targets(np.zeros(24))
    with pytest.raises(UnknownNameError, match="HeadYaw"):
        hung.set_angles("Headyaw2", 0)


def test_rounding_at_a_limit_is_forgiven(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles("HeadYaw", HIGH[0] + 1e-10)
    assert hung.targets[0] == HIGH[0]
