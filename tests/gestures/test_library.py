"""Every gesture of the library goes through the same contract."""

import numpy as np
import pytest

from nao_sim.gestures import GestureError, UnknownGesture, find_gesture, library, mirrored, prepare, vocabulary, written
from nao_sim.gestures.act import act
from nao_sim.motion import check
from nao_sim.motion.measures import Criteria, measure
from nao_sim.robot import ACTUATED, Nao, posture

GESTURES = library()
PLAYED = [name for name, gesture in GESTURES.items() if gesture.walk is None]
# A twin is played too, but one of each pair is enough for what symmetry settles.
WRITTEN = [name for name in PLAYED if not name.startswith("left_") and name != "bye_left"]
HOME = np.array([posture("StandInit")[name] for name in ACTUATED])


@pytest.fixture(scope="module")
def nao():
    return Nao()


@pytest.fixture(scope="module")
def performances(nao):
    done = {}

    def perform_once(name):
        if name not in done:
            nao.reset()
            played = act(nao, GESTURES[name])
            done[name] = played, measure(nao.model, played.trajectory, played.log)
        return done[name]

    return perform_once


def test_all_22_classes_are_there_with_the_vocabulary_s_meaning():
    assert len(vocabulary()) == 22
    for name, entry in vocabulary().items():
        gesture = GESTURES[name]
        assert (gesture.number, gesture.family, gesture.kind) == (entry.number, entry.family, entry.kind)
        assert (gesture.title, gesture.mirror) == (entry.title, entry.mirror)
        assert gesture.communicative_class == entry.communicative_class
    assert {"idle", "congratulate", "prompt"} <= set(GESTURES)


def test_listed_by_family_and_number():
    known = [name for name in GESTURES if name in vocabulary()]
    places = [(["static", "small", "large"].index(GESTURES[name].family), GESTURES[name].number) for name in known]
    assert places == sorted(places)


def test_every_gesture_s_twin_is_in_the_library():
    assert {gesture.mirror for gesture in GESTURES.values()} == set(GESTURES)


@pytest.mark.parametrize("name", GESTURES)
def test_mirrored_twice_is_itself(name):
    gesture = GESTURES[name]
    assert mirrored(mirrored(gesture)) == gesture
    assert mirrored(gesture).name == gesture.mirror


@pytest.mark.parametrize("name", PLAYED)
def test_the_robot_may_do_it_as_written(name):
    trajectory = written(GESTURES[name])
    check(trajectory, "thesis")
    check(trajectory, "envelope")
    assert np.allclose(trajectory.targets[0], HOME, atol=np.deg2rad(0.5))
    assert trajectory.duration == pytest.approx(GESTURES[name].duration_s, abs=0.25)


@pytest.mark.parametrize("name", PLAYED)
def test_it_starts_and_ends_at_rest(name):
    speeds = written(GESTURES[name]).speeds()
    assert speeds[[0, -1]].max() < 0.2


@pytest.mark.parametrize("name", WRITTEN)
def test_performed_on_its_own_feet(name, performances):
    _, measures = performances(name)
    assert Criteria(self_distance_mm=5.0, com_margin_mm=30.0, tracking_deg=2.0).faults(measures) == []
    assert measures.ends_standing


@pytest.mark.parametrize("name", WRITTEN)
def test_no_joint_reaches_its_stop(name, performances, nao):
    played, _ = performances(name)
    ranges = np.array([nao.model.joint(joint).range for joint in ACTUATED])
    assert (played.log.angles > ranges[:, 0] - 1e-3).all()
    assert (played.log.angles < ranges[:, 1] + 1e-3).all()


def test_cyclic_gestures_come_back_and_linear_ones_stay():
    for name in ("yes", "no", "bye_right", "bye_two_hands", "kowtow", "right_arm_rotation_cw", "idle"):
        assert np.allclose(written(GESTURES[name]).targets[-1], HOME, atol=np.deg2rad(0.5)), name
    for name in ("stop", "right_arm_up", "right_arm_pointing_right"):
        assert np.abs(written(GESTURES[name]).targets[-1] - HOME).max() > np.deg2rad(40), name


def hand_path(name, nao):
    """Return the right hand's y (left) and z (up) relative to the torso while the gesture is played."""
    nao.reset()
    log = act(nao, GESTURES[name]).log
    hand = log.body_pose[:, nao.model.body("r_hand").id, :3] - log.torso_pose[:, :3]
    return hand[:, 1], hand[:, 2]


def test_the_bow_is_sixty_degrees_and_back_up(performances):
    played, _ = performances("kowtow")
    _, x, y, _ = played.log.torso_pose[:, 3:].T
    lean_deg = np.rad2deg(np.arccos(1 - 2 * (x * x + y * y)))
    assert lean_deg.max() >= 60.0
    assert lean_deg[-1] < 10.0


@pytest.mark.parametrize(("name", "clockwise"), [("right_arm_rotation_cw", True), ("right_arm_rotation_ccw", False)])
def test_rotation_turns_as_the_camera_sees_it(name, clockwise, nao):
    """A camera that faces the robot has its left on the right: image x is the robot's y."""
    y, z = hand_path(name, nao)
    angle = np.unwrap(np.arctan2(z - z.mean(), y - y.mean()))
    turned = (angle[-1] - angle[0]) / (2 * np.pi)
    assert turned == pytest.approx(-1.0 if clockwise else 1.0, abs=0.15)


def test_pointing_is_level_to_its_own_side_and_looked_at(performances, nao):
    played, _ = performances("right_arm_pointing_right")
    log = played.log
    hand = log.body_pose[-1, nao.model.body("r_hand").id, :3]
    shoulder = log.body_pose[-1, nao.model.body("r_shoulder").id, :3]
    reach = hand - shoulder
    assert reach[1] < -0.13
    assert abs(reach[2]) < 0.03
    assert np.rad2deg(log.angles[-1, ACTUATED.index("HeadYaw")]) < -45


def test_walking_left_to_right_goes_to_the_robot_s_own_left():
    assert GESTURES["walk_left_to_right"].walk.y >= 0.30
    assert GESTURES["walk_right_to_left"].walk.y <= -0.30
    with pytest.raises(GestureError, match="is a walk"):
        prepare(GESTURES["walk_left_to_right"])


def test_repetitions_speed_and_amplitude():
    yes = GESTURES["yes"]
    pitch = ACTUATED.index("HeadPitch")
    once, five = yes.trajectory(repetitions=1), yes.trajectory(repetitions=5)
    assert five.duration - once.duration == pytest.approx(4 * 0.6, abs=0.03)
    assert yes.trajectory(speed=0.5).duration == pytest.approx(2 * yes.trajectory().duration, abs=0.05)
    small, large = (np.ptp(yes.trajectory(amplitude=size).targets[:, pitch]) for size in (0.5, 1.2))
    assert large / small == pytest.approx(2.4, rel=0.02)


def test_a_wave_gets_wider_and_not_higher():
    bye, pitch, elbow = GESTURES["bye_right"], ACTUATED.index("RShoulderPitch"), ACTUATED.index("RElbowRoll")
    usual, small = bye.trajectory().targets, bye.trajectory(amplitude=0.5).targets
    assert small[:, pitch].min() == pytest.approx(usual[:, pitch].min(), abs=1e-6)
    assert np.ptp(small[100:150, elbow]) < 0.7 * np.ptp(usual[100:150, elbow])


def test_what_the_motors_cannot_follow_gets_more_time():
    no = GESTURES["no"]
    prepared = prepare(no, speed=3.0, amplitude=1.5)
    check(prepared.trajectory)
    assert any(change.joint == "HeadYaw" and change.what == "speed" for change in prepared.changes)
    assert prepared.trajectory.duration > no.duration_s / 3


@pytest.mark.parametrize(("asked", "value"), [("speed", 0.0), ("speed", 9.0), ("amplitude", -1.0), ("repetitions", 0)])
def test_asking_for_nonsense_is_refused(asked, value):
    with pytest.raises(GestureError, match="choose"):
        prepare(GESTURES["yes"], **{asked: value})


def test_a_gesture_starts_where_the_last_one_ended(nao):
    nao.reset()
    act(nao, GESTURES["right_arm_up"])
    before = nao.setpoint
    played = act(nao, GESTURES["yes"])
    assert not played.log.fallen
    assert np.allclose(played.trajectory.targets[0], before, atol=np.deg2rad(2.0))
    assert np.allclose(played.trajectory.targets[-1], HOME, atol=np.deg2rad(0.5))


def test_unknown_names_get_the_nearest():
    with pytest.raises(UnknownGesture, match=r"no gesture named 'bye_rigth'; did you mean 'bye_right'\?"):
        find_gesture("bye_rigth")
