"""The joint table says what the thesis says."""

from __future__ import annotations

import tomllib

import numpy as np
import pytest

from nao_sim.resources import resource
from nao_sim.robot import ACTUATED, BODY, CHAINS, UnknownNameError, joint_table, posture, postures, resolve

# Table A1-1 of the thesis, typed again from its text.
THESIS_DEG = {
    "HeadYaw": (-120, 120), "HeadPitch": (-39, 30),
    "LShoulderPitch": (-120, 120), "RShoulderPitch": (-120, 120),
    "LShoulderRoll": (0, 95), "RShoulderRoll": (-95, 0),
    "LElbowYaw": (-120, 120), "RElbowYaw": (-120, 120),
    "LElbowRoll": (-90, 0), "RElbowRoll": (0, 90),
    "LWristYaw": (-105, 105), "RWristYaw": (-105, 105),
    "LHipYawPitch": (-44, 68), "RHipYawPitch": (-68, 44),
    "LHipPitch": (-104.5, 28.5), "RHipPitch": (-104.5, 28.5),
    "LHipRoll": (-25, 45), "RHipRoll": (-45, 25),
    "LKneePitch": (-5, 125), "RKneePitch": (-5, 125),
    "LAnklePitch": (-70.5, 54), "RAnklePitch": (-70.5, 54),
    "LAnkleRoll": (-45, 25), "RAnkleRoll": (-25, 45),
}  # fmt: skip
# Table A1-3: reduction -> no-load deg/s, stall Nm, nominal deg/s (thesis rounds or truncates the last digit).
THESIS_MOTORS = {
    201.3: (238.45, 11.97, 188.67),
    130.85: (366.83, 7.78, 290.25),
    150.27: (475.14, 2.27, 351.77),
    173.22: (412.19, 2.61, 305.16),
}


def test_names_are_26_and_motors_25() -> None:
    assert len(BODY) == 26
    assert len(set(BODY)) == 26
    assert [name for name in BODY if name != "RHipYawPitch"] == list(ACTUATED)


@pytest.mark.parametrize("name", THESIS_DEG)
def test_thesis_row(name: str) -> None:
    joint = joint_table()[name]
    ends = sorted(np.degrees(joint.thesis) * joint.thesis_sign)
    assert ends == pytest.approx(THESIS_DEG[name], abs=1e-9)


def test_only_three_rows_change_sign() -> None:
    changed = {j.name for j in joint_table().joints if j.thesis_sign == -1}
    assert changed == {"LHipYawPitch", "LAnkleRoll", "RAnkleRoll"}


def test_motors_give_the_thesis_s_joint_figures() -> None:
    for joint in joint_table().joints:
        if joint.reduction in THESIS_MOTORS:
            speed, stall, nominal = THESIS_MOTORS[joint.reduction]
            assert np.degrees(joint.no_load_speed) == pytest.approx(speed, abs=0.011)
            assert joint.stall_torque == pytest.approx(stall, abs=0.011)
            assert np.degrees(joint.nominal_speed) == pytest.approx(nominal, abs=0.011)


def test_torque_limits_lie_between_nominal_and_stall() -> None:
    for joint in joint_table().joints:
        if joint.reduction in THESIS_MOTORS:
            nominal = joint.motor.nominal_mnm * 1e-3 * joint.reduction
            assert nominal < joint.effort_nm < joint.stall_torque


def test_envelope_is_inside_both_sets() -> None:
    low, high = joint_table().range_rad("envelope").T
    for limits in ("thesis", "v5"):
        outer_low, outer_high = joint_table().range_rad(limits).T
        assert (low >= outer_low).all()
        assert (high <= outer_high).all()
    assert (low < high).all()


def test_left_and_right_ranges_mirror() -> None:
    table = joint_table()
    for name in BODY:
        if not name.startswith("L"):
            continue
        left, right = table[name].thesis, table["R" + name[1:]].thesis
        turned = name.endswith(("Roll", "ElbowYaw", "WristYaw"))
        assert right == pytest.approx((-left[1], -left[0]) if turned else left)


def test_chains_resolve() -> None:
    assert resolve("Head") == ["HeadYaw", "HeadPitch"]
    assert resolve("Body") == list(BODY)
    assert resolve(["LArm", "HeadYaw"]) == [*CHAINS["LArm"], "HeadYaw"]
    assert len(resolve("JointActuators")) == 25
    assert len(resolve("Legs")) == len(resolve("Arms")) == 12


@pytest.mark.parametrize(
    ("ask", "near"), [("LElbowRol", "LElbowRoll"), ("larm", "LArm"), ("HeadYow", "HeadYaw"), ("LKnee", "LKneePitch")]
)
def test_unknown_joint_names_the_nearest(ask: str, near: str) -> None:
    with pytest.raises(UnknownNameError, match=f"'{ask}'.*'{near}'"):
        resolve(ask)


def test_unknown_limit_set_and_posture() -> None:
    with pytest.raises(UnknownNameError, match="thesis"):
        joint_table().range_rad("v9")
    with pytest.raises(UnknownNameError, match="StandInit"):
        posture("StandInitt")


def test_postures_fit_v5_and_thesis_but_for_the_knees() -> None:
    for limits, slack in (("v5", 0.011), ("thesis", 0.3)):
        low, high = np.degrees(joint_table().range_rad(limits).T)
        for name, wanted in postures().items():
            angles = np.degrees(wanted.angles)
            outside = [BODY[k] for k in np.flatnonzero((angles < low - slack) | (angles > high + slack))]
            assert outside == [], (limits, name)
            assert (wanted.clamped(limits) >= joint_table().range_rad(limits)[:, 0]).all()


def test_link_masses_add_up_to_the_documented_sum() -> None:
    links = tomllib.loads(resource("assets", "nao", "links.toml").read_text("utf-8"))
    total = sum(v["mass_kg"] * (2 if k.startswith("l_") else 1) for k, v in links.items() if isinstance(v, dict))
    assert total == pytest.approx(5.30535, abs=1e-9)
