from dataclasses import replace

import numpy as np
import pytest

from nao_sim.gestures import GestureError, KeyFrame, library, load_gesture, save_trajectory
from nao_sim.gestures.act import act, motion_of
from nao_sim.gestures.validation import validate_gesture
from nao_sim.motion import Trajectory
from nao_sim.motion.getting_up import stands
from nao_sim.motion.stress import stress
from nao_sim.robot import ACTUATED, Nao


@pytest.fixture(scope="module")
def nao():
    return Nao()


@pytest.mark.parametrize(("name", "side"), [("walk_left_to_right", 1), ("walk_right_to_left", -1)])
def test_walking_gestures_go_thirty_centimetres_to_their_side(name, side, nao):
    nao.reset()
    log = act(nao, library()[name]).log
    moved = log.torso_pose[-1, :2] - log.torso_pose[0, :2]
    assert not log.fallen
    assert side * moved[1] >= 0.30
    assert abs(moved[0]) < 0.06


def test_a_walk_goes_as_far_as_its_amplitude(nao):
    nao.reset()
    log = act(nao, library()["walk_left_to_right"], amplitude=0.5).log
    assert log.torso_pose[-1, 1] - log.torso_pose[0, 1] == pytest.approx(0.175, abs=0.03)
    with pytest.raises(GestureError, match="keeps its own pace"):
        act(nao, library()["walk_left_to_right"], speed=2.0)


def test_a_walk_after_a_raised_arm_comes_home_first(nao):
    nao.reset()
    act(nao, library()["right_arm_up"])
    begun = nao.time
    log = act(nao, library()["walk_right_to_left"], amplitude=0.3).log
    assert not log.fallen
    assert np.allclose(np.diff(log.time), 0.02)
    assert log.time[-1] == pytest.approx(nao.time - begun)
    assert log.torso_pose[-1, 1] < log.torso_pose[0, 1] - 0.05


def test_walks_pass_the_walking_criteria():
    found = validate_gesture("walk_left_to_right")
    assert found.faults == []
    assert found.measures.tracking_deg.value < 5.0


def test_walks_are_stressed_with_their_own_feedback():
    report = stress(motion_of(library()["walk_left_to_right"]), 4, 1, sweep=False, threads=1)
    assert report.upright_share == 1.0


@pytest.mark.parametrize("place", ["Crouch", "SitRelax", "LyingBelly"])
def test_a_robot_that_does_not_stand_gets_up_first(place):
    nao = Nao(posture=place)
    nao.step(10)
    log = act(nao, library()["yes"], repetitions=1).log
    assert not log.fallen
    assert stands(nao)
    assert np.allclose(np.diff(log.time), 0.02)
    head = log.targets[:, ACTUATED.index("HeadPitch")]
    assert np.ptp(head[-100:]) > np.deg2rad(8)


def test_what_cannot_get_up_says_so_and_does_not_begin():
    nao = Nao("v5", posture="LyingBack")
    nao.step(10)
    done = act(nao, library()["bye_right"])
    assert done.log.fallen
    assert done.changes == []


def test_gestures_have_bounds(write):
    yes = library()["yes"]
    for worse, said in (
        (replace(yes, follow_through_s=1e6), "follow_through_s is 1e.06; choose from 0 to 1"),
        (replace(yes, follow_through_s=-0.1), "follow_through_s is -0.1"),
        (replace(yes, key_frames=(*yes.key_frames, KeyFrame(1e9, {"HeadYaw": 0.1}))), "may last 300 s"),
    ):
        with pytest.raises(GestureError, match=said):
            worse.trajectory()
    with pytest.raises(GestureError, match="may last 4 s"):
        replace(yes, longest_s=4.0).trajectory(repetitions=20)
    assert replace(yes, longest_s=40.0).trajectory(repetitions=20).duration > 10.0
    frame = "[[key_frame]]\ntime = {}\nangles = {{ HeadYaw = 10 }}\n"
    for text, said in (
        (frame.format(1e9), "lasts 32 years; times are seconds and a motion may last 5 minutes"),
        ("follow_through_s = -1\n" + frame.format(1), "follow_through_s is -1"),
        ("mirror = 3\n" + frame.format(1), "mirror is 3; write words"),
    ):
        with pytest.raises(GestureError, match=said):
            load_gesture(write(text))
    assert load_gesture(write("\ufeff" + frame.format(1))).key_frames[0].time_s == 1


@pytest.mark.parametrize("suffix", [".csv", ".motion", ".parquet"])
def test_what_the_robot_measured_can_be_read_and_commanded_again(nao, tmp_path, suffix):
    nao.reset()
    log = act(nao, library()["bye_right"], repetitions=1).log
    save_trajectory(Trajectory(log.time, log.angles), tmp_path / f"measured{suffix}")
    again = load_gesture(tmp_path / f"measured{suffix}")
    nao.reset()
    replayed = act(nao, again)
    assert not replayed.log.fallen
    assert not any(change.what == "angle" for change in replayed.changes)
