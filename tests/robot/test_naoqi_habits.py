"""What people who know NAOqi look for: angles by name, a share of the speed, an interpolation."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.robot import ACTUATED, CHAINS, AngleRangeError, Nao, TargetError, UnknownNameError, joint_table


def test_angles_by_name_are_those_of_the_joints(standing: Nao) -> None:
    standing.reset("Stand")
    body = standing.get_angles("Body")
    assert body.shape == (26,)
    by_name = dict(zip(CHAINS["Body"], body, strict=True))
    assert [by_name[name] for name in ACTUATED] == standing.angles.tolist()
    assert standing.get_angles(["RHand", "Head"]).tolist() == [by_name[n] for n in ("RHand", "HeadYaw", "HeadPitch")]
    assert standing.get_angles("RHipYawPitch")[0] == pytest.approx(by_name["LHipYawPitch"], abs=1e-3)
    standing.set_angles("Body", body)
    with pytest.raises(UnknownNameError, match="did you mean 'HeadYaw'"):
        standing.get_angles("headyaw")


def test_who_gives_the_motors_angles_for_the_body_is_told_the_name(standing: Nao) -> None:
    with pytest.raises(TargetError, match=r"25 angles for the 26 joints of 'Body'; .*'JointActuators'"):
        standing.set_angles("Body", standing.angles)
    standing.set_angles("JointActuators", standing.angles)


@pytest.mark.parametrize("share", [0.05, 0.3, 1.0])
def test_a_share_of_the_speed_is_kept(share: float, hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles("HeadYaw", 2.0, speed=share)
    hung.set_angles("LElbowYaw", -1.5)
    fastest = np.zeros(25)
    for _ in range(40):
        before = hung.setpoint
        hung.step()
        fastest = np.maximum(fastest, np.abs(hung.setpoint - before) / 0.02)
    nominal = joint_table().select(ACTUATED).max_speed_rad()
    yaw, elbow = ACTUATED.index("HeadYaw"), ACTUATED.index("LElbowYaw")
    assert fastest[yaw] == pytest.approx(share * nominal[yaw], rel=1e-6)
    assert fastest[elbow] == pytest.approx(nominal[elbow], rel=1e-6)
    hung.set_angles("HeadYaw", -2.0)
    hung.step(10)
    assert np.abs(hung.velocities[yaw]) > 0.8 * nominal[yaw]


@pytest.mark.parametrize("share", [0.0, -1.0, 1.5, float("nan")])
def test_no_such_speed(share: float, hung: Nao) -> None:
    with pytest.raises(TargetError, match="share of the nominal speed"):
        hung.set_angles("HeadYaw", 0.1, speed=share)


def test_an_interpolation_takes_its_time_and_moves_evenly(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.interpolate(["HeadYaw", "LHand"], [0.8, 1.0], 2.0)
    assert hung.time == pytest.approx(2.0)
    assert hung.targets[0] == 0.8
    hung.step(10)
    assert hung.get_angles(["HeadYaw", "LHand"]) == pytest.approx([0.8, 1.0], abs=0.01)
    begun = hung.time
    with pytest.raises(AngleRangeError):
        hung.interpolate("HeadYaw", 3.0, 1.0)
    with pytest.raises(TargetError, match="seconds above 0"):
        hung.interpolate("HeadYaw", 0.0, 0.0)
    assert hung.time == begun


def test_the_robot_is_known_to_type_checkers() -> None:
    import nao_sim

    assert "Nao" in dir(nao_sim)
    assert "Nao" in nao_sim.__all__
