import numpy as np
import pytest

from nao_sim.gestures import GestureError, library
from nao_sim.gestures.act import act, motion_of
from nao_sim.gestures.validation import validate_gesture
from nao_sim.motion.stress import stress
from nao_sim.robot import Nao


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
