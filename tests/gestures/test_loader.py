# ruff: noqa: E501 - a table of changes and messages reads best a line each
import numpy as np
import pytest

from nao_sim.gestures import GestureFileError, load_gesture


def test_reads_what_is_written(write, good):
    gesture = load_gesture(write(good))
    assert (gesture.name, gesture.kind, gesture.family) == ("hello", "cyclic", "own")
    assert gesture.mirror == "hello_mirrored"
    assert gesture.key_frames[0].angles_rad["RShoulderPitch"] == pytest.approx(np.deg2rad(20))
    assert gesture.key_frames[0].angles_rad["RHand"] == 1.0
    assert gesture.key_frames[-1].rest
    assert gesture.cycle.repetitions == 2
    assert gesture.duration_s == pytest.approx(2.0 + 0.8)


def test_one_motor_for_both_hip_yaw_pitch_joints(write):
    gesture = load_gesture(write("[[key_frame]]\ntime = 1\nangles = { RHipYawPitch = -5 }"))
    assert gesture.joints == ("LHipYawPitch",)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (("RElbowRoll = 60", "RElbowRol = 60"), r"key frame 2: unknown joint 'RElbowRol'; did you mean 'RElbowRoll'\?"),
        (("RElbowRoll = 60", "RElbowRoll = 95"), r"RElbowRoll at 0\.9 s is 95\.00, outside its 'thesis' range 0\.00 \.\. 90\.00"),
        (("RHand = 1", "RHand = 1.5"), r"RHand at 0\.5 s is 1\.50, outside its 'thesis' range 0\.00 \.\. 1\.00 \(0 closed"),
        (("time = 0.9", "time = 0.4"), r"key frame 2 is at 0\.4 s, not after 0\.5 s"),
        (("time = 0.9", "time = 0.5"), r"key frame 2 is at 0\.5 s, not after 0\.5 s"),
        (("time = 0.5", "time = -1"), r"key frame 1 is at -1 s; times start at 0"),
        (("time = 0.5", "time = nan"), r"time of key frame 1 is nan; write a finite number"),
        (("time = 0.5", 'time = "now"'), r"time of key frame 1 is 'now'"),
        (("time = 0.5\n", ""), r"key frame 1 has no time"),
        (("RElbowRoll = 60", "RElbowRoll = inf"), r"RElbowRoll in key frame 2 is inf"),
        (("angles = { RElbowRoll = 60 }", "angles = 60"), r"angles of key frame 2 is 60; write a table"),
        (("angles = { RElbowRoll = 60 }", ""), r"key frame 2 moves nothing"),
        (("angles = { RElbowRoll = 60 }", "torso = { yaw = 3 }"), r"torso of key frame 2 has an unknown key 'yaw'"),
        (("rest = true", "rest = 1"), r"key frame 4: rest is true or false"),
        (("rest = true", "rest = true\nmark = 3"), r"mark of key frame 4 is 3"),
        (('kind = "cyclic"', 'kind = "round"'), r"kind is 'round'; write one of posture, cyclic, linear"),
        (('kind = "cyclic"', 'easing = "bounce"'), r"easing is 'bounce'; write one of minimum_jerk, cubic"),
        (('kind = "cyclic"', "speed = 2"), r"the file has an unknown key 'speed'"),
        (('name = "hello"', "name = 3"), r"name is 3; write a word"),
        (('name = "hello"', 'name = "yes"'), r"'yes' is in the vocabulary, which gives its kind; leave it out"),
        (('first = "out"', 'first = "up"'), r"cycle first is 'up'; no key frame has that mark"),
        (('first = "out", last = "out_again"', 'first = "out_again", last = "out"'), r"cycle ends at 'out'"),
        (("repetitions = 2", "repetitions = 0"), r"cycle repetitions is 0; write 1 or more"),
        (("RShoulderPitch = 20, RElbowRoll = 40, RHand = 1 }\nmark = \"out\"", "RShoulderPitch = 30 }\nmark = \"out\""), r"cycle: \w+ must be the same at 'out' and 'out_again'"),
        (("[[key_frame]]\ntime = 2.0", "[walk]\ny = 1\n[[key_frame]]\ntime = 2.0"), r"either \[\[key_frame\]\] tables or one"),
        (("[[key_frame]]\ntime = 2.0\nrest = true", "[[key_frame]"), r"is not TOML: .*line"),
    ],
)  # fmt: skip
def test_bad_files_are_refused_with_the_place_and_the_mend(write, good, change, message):
    text = good.replace(*change, 1)
    assert text != good
    path = write(text)
    with pytest.raises(GestureFileError, match=message) as caught:
        load_gesture(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_fit_leaves_angles_for_fitting_to_clip(write, good):
    gesture = load_gesture(write(good.replace("RElbowRoll = 60", "RElbowRoll = 95")), fit=True)
    assert np.rad2deg(gesture.key_frames[1].angles_rad["RElbowRoll"]) == pytest.approx(95)


def test_places_that_are_no_gesture_file(tmp_path, write):
    with pytest.raises(GestureFileError, match="no such gesture file"):
        load_gesture(tmp_path / "none.toml")
    (tmp_path / "folder.toml").mkdir()
    with pytest.raises(GestureFileError, match="is a folder"):
        load_gesture(tmp_path / "folder.toml")
    with pytest.raises(GestureFileError, match="is not UTF-8 text"):
        load_gesture(write(b'name = "\xff\xfe"'))
    with pytest.raises(GestureFileError, match=r"unknown suffix '.bvh'; known: .toml"):
        load_gesture(write("", "hello.bvh"))
    with pytest.raises(GestureFileError, match="has no key frames"):
        load_gesture(write("key_frame = []"))


def test_walks_are_metres_and_degrees(write):
    gesture = load_gesture(write('name = "go"\n[walk]\nx = 0.2\nturn = 90', "go.toml"))
    assert (gesture.walk.x, gesture.walk.y, gesture.walk.turn) == pytest.approx((0.2, 0.0, np.pi / 2))
    assert gesture.duration_s is None
    with pytest.raises(GestureFileError, match="walk goes nowhere"):
        load_gesture(write("[walk]\nx = 0"))
