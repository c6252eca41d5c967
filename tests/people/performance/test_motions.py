"""What people do on video is what the table of gestures says, for every label, person and size."""

import mujoco
import numpy as np
import pytest

from nao_sim.people.actors.figure import skeleton
from nao_sim.people.datasets.manifest import known_labels
from nao_sim.people.filming.photos import postures
from nao_sim.people.filming.shots import draw_cast
from nao_sim.people.performance.motions import IRRELEVANT, drawn_offsets, hand_postures, joints, motions, pose, tables
from nao_sim.people.performance.perform import CLIP_SECONDS, perform
from nao_sim.people.performance.planning import SIZE, TEMPO
from nao_sim.people.performance.strokes import minimum_jerk

DYNAMIC = [label for label, family in known_labels().items() if family in ("small", "large")]
CAST = draw_cast(7, 6)
MODEL = skeleton().compile()
DATA = mujoco.MjData(MODEL)


def track(performance, body, count=60):
    """World positions (count, 3) of a body of the 1.75 m person."""
    path = []
    for angles in performance.angles(np.linspace(0, performance.seconds, count)):
        DATA.qpos[:] = angles
        mujoco.mj_kinematics(MODEL, DATA)
        path.append(np.array(DATA.body(body).xpos))
    return np.array(path)


def performances(label, count=6, **more):
    """By default of whole motions."""
    whole = {"underway": 0.0} | more
    return [perform(label, CAST[k % 6], np.random.default_rng([k, 3]), 1.0, **whole) for k in range(count)]


def test_a_wave_underway_is_seen_with_the_arm_up_throughout():
    for done in performances("bye_right", 12, underway=1.0):
        hand, elbow = track(done, "r_middle_1")[:, 2], track(done, "r_forearm")[:, 2]
        assert done.underway
        assert hand.min() > elbow.max() - 0.1
        assert CLIP_SECONDS[0] <= done.seconds <= CLIP_SECONDS[1]


def test_a_motion_underway_goes_on_at_both_ends_of_the_clip():
    for done in performances("no", 8, underway=1.0, restless=0.0):
        turn = done.angles(np.linspace(0, done.seconds, 200))[:, joints()["head_yaw"]]
        turn = turn - turn.mean()
        quarter = len(turn) // 4
        assert np.ptp(turn[:quarter]) > 0.4 * np.ptp(turn)
        assert np.ptp(turn[-quarter:]) > 0.4 * np.ptp(turn)


def test_what_is_not_repeated_is_never_underway_and_the_rest_stays_as_it_was():
    assert not any(done.underway for done in performances("stop", underway=1.0))
    drawn = performances("yes", 40, underway=None)
    assert 0 < sum(done.underway for done in drawn) < 20
    for one, other in zip(drawn, performances("yes", 40), strict=True):
        if not one.underway:
            times = np.linspace(0, one.seconds, 5)
            np.testing.assert_array_equal(one.angles(times), other.angles(times))


def test_slow_waves_are_more_often_seen_without_their_beginning_and_end():
    shares = {motion.underway for motion in motions()["bye_right"]}
    usual, slow = sorted(shares)
    assert usual == tables()["underway"]["share"]
    drawn = performances("bye_two_hands", 150, underway=None)
    assert 150 * usual * 0.6 < sum(done.underway for done in drawn) < 150 * slow


def test_who_cannot_keep_still_sways_more_and_stands_on_the_same_feet():
    still, restless = (performances("stop", 12, restless=share) for share in (0.0, 1.0))
    sways = [np.ptp([track(p, "head", 30)[:, 1] for p in some], axis=1) for some in (still, restless)]
    assert np.median(sways[1]) > 2 * np.median(sways[0])
    assert np.max(sways[1]) > 0.23  # m: more than the head is high
    for foot in ("r_foot", "l_foot"):
        steps = [np.ptp(track(p, foot, 30)[:, 1]) for p in restless]
        assert np.all(np.array(steps) < 0.35 * sways[1] + 0.02)
    assert all(np.array_equal(a.strokes[0].knots, b.strokes[0].knots) for a, b in zip(still, restless, strict=True))


def test_every_dynamic_class_and_ten_other_motions_can_be_performed():
    assert set(motions()) == {*DYNAMIC, IRRELEVANT}
    assert len({motion.action for motion in motions()[IRRELEVANT]}) >= 10
    assert set(postures()) == {label for label, family in known_labels().items() if family == "static"}
    assert set(postures()) <= set(hand_postures())


@pytest.mark.parametrize("name", list(tables()["pose"]))
def test_poses_stay_inside_the_joints_ranges(name):
    angles = pose(name).angles
    for joint, k in joints().items():
        if MODEL.jnt_limited[k]:
            low, high = MODEL.jnt_range[k]
            assert low - 1e-9 <= angles[k] <= high + 1e-9, joint


@pytest.mark.parametrize("name", list(tables()["pose"]))
def test_mirroring_a_pose_moves_the_other_hand_to_the_mirrored_place(name):
    hands = []
    for mirrored in (False, True):
        DATA.qpos[:] = pose(name, mirrored).angles
        mujoco.mj_kinematics(MODEL, DATA)
        hands.append({side: np.array(DATA.body(f"{side}_hand").xpos) for side in "rl"})
    assert np.allclose(hands[0]["r"] * [1, -1, 1], hands[1]["l"], atol=1e-9)
    assert np.allclose(hands[0]["l"] * [1, -1, 1], hands[1]["r"], atol=1e-9)


def test_a_stroke_starts_and_ends_at_rest():
    share = np.linspace(0, 1, 1001)
    way = minimum_jerk(share)
    assert way[0] == 0
    assert way[-1] == pytest.approx(1)
    speed = np.gradient(way, share)
    assert max(speed[0], speed[-1]) < 1e-2
    assert speed.max() == pytest.approx(1.875, rel=1e-3)  # Flash & Hogan: 1.875 times the mean speed


@pytest.mark.parametrize("label", [*DYNAMIC, IRRELEVANT])
def test_performances_are_drawn_within_what_they_promise(label):
    for done in performances(label):
        assert TEMPO[0] <= done.tempo <= TEMPO[1]
        assert SIZE[0] <= done.size <= SIZE[1]
        assert CLIP_SECONDS[0] <= done.seconds
        angles = done.angles(np.linspace(0, done.seconds, 200))
        assert np.isfinite(angles).all()
        limited = MODEL.jnt_limited.astype(bool)
        low, high = MODEL.jnt_range[limited].T
        assert (angles[:, limited] >= low).all()
        assert (angles[:, limited] <= high).all()


def test_the_same_seed_gives_the_same_performance():
    one, two = (perform("bye_right", CAST[0], np.random.default_rng(5), 1.0) for _ in range(2))
    times = np.linspace(0, one.seconds, 30)
    assert np.array_equal(one.angles(times), two.angles(times))


@pytest.mark.parametrize(("label", "waving", "still"), [("bye_right", "r", "l"), ("bye_left", "l", "r")])
def test_bye_waves_the_hand_of_its_side_between_shoulder_and_head(label, waving, still):
    for done in performances(label):
        hand, other = track(done, f"{waving}_hand"), track(done, f"{still}_hand")
        shoulder = track(done, f"{waving}_upper_arm")
        high = hand[:, 2] > shoulder[:, 2] - 0.05
        assert high.mean() > 0.2
        sideways = np.diff(hand[high, 1])
        assert (np.diff(np.sign(sideways[np.abs(sideways) > 1e-3])) != 0).sum() >= 2
        assert other[:, 2].max() < 1.0


def test_bye_two_hands_raises_both():
    for done in performances("bye_two_hands"):
        assert all(track(done, f"{side}_hand")[:, 2].max() > 1.3 for side in "rl")


def test_right_arm_up_and_down_end_where_they_should():
    for done in performances("right_arm_up"):
        hand = track(done, "r_hand")
        assert hand[0, 2] < 1.0
        assert hand[-1, 2] > 1.7
    for done in performances("right_arm_down"):
        hand = track(done, "r_hand")
        assert hand[0, 2] > 1.7
        assert hand[-1, 2] < 1.0


@pytest.mark.parametrize(("label", "turn"), [("right_arm_rotation_cw", 1), ("right_arm_rotation_ccw", -1)])
def test_rotation_turns_once_the_way_the_camera_sees(label, turn):
    for done in performances(label):
        arm = track(done, "r_hand", 200) - track(done, "r_upper_arm", 200)
        # The camera sees y to the right and z up: its clockwise angle from hanging grows by way of -y.
        angle = np.unwrap(np.arctan2(-arm[:, 1], -arm[:, 2]))
        assert turn * (angle[-1] - angle[0]) == pytest.approx(2 * np.pi, abs=0.5)


@pytest.mark.parametrize(
    ("label", "side", "sign"), [("right_arm_pointing_right", "r", -1), ("left_arm_pointing_left", "l", 1)]
)
def test_pointing_ends_sideways_and_level(label, side, sign):
    for done in performances(label):
        arm = (track(done, f"{side}_hand") - track(done, f"{side}_upper_arm"))[-1]
        assert sign * arm[1] > 0.4
        assert abs(arm[2]) < 0.25


@pytest.mark.parametrize(("label", "sign"), [("walk_left_to_right", 1), ("walk_right_to_left", -1)])
def test_walks_cross_the_image(label, sign):
    for done in performances(label):
        path = track(done, "pelvis")[:, 1]
        assert sign * path[0] < -0.4
        assert sign * path[-1] > 0.4


def test_stop_brings_the_palm_forward_and_holds_it():
    for done in performances("stop", restless=0.0):
        hand, shoulder = track(done, "r_hand"), track(done, "r_upper_arm")
        assert (hand[-1] - shoulder[-1])[0] > 0.15
        assert np.ptp(hand[-6:], axis=0).max() < 0.08


def test_kowtow_bows_and_heads_nod_and_shake():
    for done in performances("kowtow"):
        chest = done.angles(np.linspace(0, done.seconds, 100))
        bow = sum(chest[:, joints()[f"{body}_pitch"]] for body in ("root", "waist", "chest"))
        assert np.degrees(np.ptp(bow)) > 45
    for label, joint in (("yes", "head_pitch"), ("no", "head_yaw")):
        for done in performances(label):
            assert np.degrees(np.ptp(done.angles(np.linspace(0, done.seconds, 100))[:, joints()[joint]])) > 12


def test_clip_lengths_do_not_tell_the_gesture():
    means = [np.mean([p.seconds for p in performances(label, 60)]) for label in DYNAMIC]
    assert max(means) < 1.25 * min(means)


@pytest.mark.parametrize(("action", "nearer"), [("walk_closer", True), ("walk_away", False)])
def test_walks_along_the_line_of_sight(action, nearer):
    for done in performances(IRRELEVANT, action=action):
        path = track(done, "pelvis")
        assert (path[-1, 0] > path[0, 0] + 0.1) == nearer
        assert np.ptp(path[:, 1]) < 0.35


def test_who_ties_a_shoe_goes_down_and_who_bows_stays_on_straight_legs():
    for done in performances(IRRELEVANT, 12, action="tie_shoe"):
        bent = np.degrees(done.angles(np.linspace(0, done.seconds, 60))[:, [joints()["r_knee"], joints()["l_knee"]]])
        assert bent.max() > 30
    for done in performances("kowtow", 12):
        bent = np.degrees(done.angles(np.linspace(0, done.seconds, 60))[:, [joints()["r_knee"], joints()["l_knee"]]])
        assert bent.max() < 15


def test_waves_differ_in_height_reach_and_tempo():
    tops, rates = [], []
    for done in performances("bye_right", 60):
        tops.append(track(done, "r_hand")[:, 2].max())
        strokes = [s.seconds for s in done.strokes if s.seconds < 0.6]
        rates.append(0.5 / np.median(strokes))
    assert np.ptp(tops) > 0.4
    assert np.percentile(rates, 5) < 1.8
    assert np.percentile(rates, 95) > 3.0
    assert max(rates) < 4.3


@pytest.mark.parametrize("mirrored", [False, True])
def test_offsets_for_both_sides_turn_them_alike_or_against_each_other(mirrored):
    rng = np.random.default_rng(0)
    alike = drawn_offsets({"b_elbow": [20, 20]}, mirrored, rng)
    against = drawn_offsets({"x_elbow": [20, 20]}, mirrored, rng)
    right, left = joints()["r_elbow"], joints()["l_elbow"]
    assert alike[right] == alike[left] == pytest.approx(np.radians(20))
    assert against[right] == -against[left] == pytest.approx(np.radians(-20 if mirrored else 20))
