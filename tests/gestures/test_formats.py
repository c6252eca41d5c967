import sys
from types import SimpleNamespace

import numpy as np
import pytest

from nao_sim.gestures import GestureFileError, library, load_gesture, save_trajectory, written
from nao_sim.motion import Trajectory
from nao_sim.robot import ACTUATED, BODY


@pytest.fixture(scope="module")
def wave():
    return library()["bye_two_hands"].trajectory()


@pytest.mark.parametrize("suffix", [".motion", ".csv"])
def test_round_trip(wave, suffix, tmp_path):
    path = tmp_path / f"wave{suffix}"
    save_trajectory(wave, path)
    back = written(load_gesture(path))
    assert back.duration == pytest.approx(wave.duration, abs=0.001)
    at = np.linspace(0, wave.duration, 300)
    assert np.abs(back.sample(at) - wave.sample(at)).max() < np.deg2rad(0.2)
    save_trajectory(back, tmp_path / f"again{suffix}")
    again = written(load_gesture(tmp_path / f"again{suffix}"))
    assert np.abs(again.targets - back.targets).max() < 1e-4


def test_webots_motions_have_webots_motors(wave, tmp_path):
    path = tmp_path / "wave.motion"
    save_trajectory(wave, path)
    lines = path.read_text().splitlines()
    names = lines[0].split(",")
    assert names[:2] == ["#WEBOTS_MOTION", "V1.0"]
    bodies = [name for name in BODY if not name.endswith("Hand")]
    fingers = [f"{side}Phalanx{number}" for side in "LR" for number in range(1, 9)]
    assert sorted(names[2:]) == sorted(bodies + fingers)
    assert lines[1].startswith("00:00:000,Pose1,")
    assert lines[51].startswith("00:01:000,Pose51,")


def test_a_webots_motion_may_leave_motors_alone(write):
    text = "#WEBOTS_MOTION,V1.0,HeadYaw,RShoulderPitch\n00:00:500,a,0.5,*\n00:01:000,b,*,0.2\n"
    gesture = load_gesture(write(text, "some.motion"))
    assert gesture.key_frames[0].angles_rad == {"HeadYaw": 0.5}
    assert gesture.key_frames[1].angles_rad == {"RShoulderPitch": 0.2}


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.motion", "HeadYaw\n", "does not start with '#WEBOTS_MOTION,V1.0'"),
        (
            "a.motion",
            "#WEBOTS_MOTION,V1.0,HeadJaw\n",
            r"line 1, column 3: unknown joint 'HeadJaw'; did you mean 'HeadYaw'",
        ),
        ("a.motion", "#WEBOTS_MOTION,V1.0,HeadYaw\n", "has no samples"),
        ("a.motion", "#WEBOTS_MOTION,V1.0,HeadYaw\n1.5,a,0\n", "line 2, column 1: '1.5' is not a time"),
        ("a.motion", "#WEBOTS_MOTION,V1.0,HeadYaw\n00:00:500,a\n", "line 2 has 0 angles, the header names 1"),
        (
            "a.motion",
            "#WEBOTS_MOTION,V1.0,HeadYaw\n00:00:500,a,x\n",
            "line 2, column 3: 'x' is not an angle in radians",
        ),
        (
            "a.motion",
            "#WEBOTS_MOTION,V1.0,HeadYaw\n00:00:500,a,3\n",
            r"HeadYaw at 0\.50 s is 171\.89, 52 beyond its 'thesis' range -120\.00 \.\. 120\.00 deg",
        ),
        (
            "a.motion",
            "#WEBOTS_MOTION,V1.0,HeadYaw\n00:00:500,a,0\n00:00:400,b,0\n",
            r"line 3 is at 0\.4 s, not after",
        ),
        ("a.csv", "", "has no header line"),
        ("a.csv", "HeadYaw\n1\n", r"has no header line with a time \(line 1: 'HeadYaw'\); write 'time_s,HeadYaw_rad"),
        ("a.csv", "time,HeadYaw\n", "has no samples"),
        ("a.csv", "time,HeadYaw,HeadYaw_rad\n1,2,3\n", "two columns for HeadYaw"),
        ("a.csv", "time,HeadYaw\n1\n", r"line 2 has 1 cells, the header \(line 1\) has 2"),
        ("a.csv", "time,HeadYaw\n1,far\n", r"line 2, column 2 \(HeadYaw\): 'far' is not a number"),
        ("a.csv", "time,HeadYaw\n1,nan\n", r"line 2, column 2 \(HeadYaw\): 'nan' is not a number"),
        (
            "a.csv",
            "time,HeadYaw\n1,140\n",
            r"HeadYaw at 1\.00 s is 140\.00, 20 beyond its 'thesis' range -120\.00 \.\. 120\.00 deg",
        ),
    ],
)
def test_bad_files_are_refused(write, name, text, message):
    with pytest.raises(GestureFileError, match=message):
        load_gesture(write(text, name))


def test_csv_units_are_said_by_the_header(write):
    gesture = load_gesture(write("time_s,HeadYaw,HeadPitch_rad,LHand\n1,90,0.3,0.5\n2,,0.1,\n", "units.csv"))
    assert gesture.key_frames[0].angles_rad == pytest.approx({"HeadYaw": np.pi / 2, "HeadPitch": 0.3, "LHand": 0.5})
    assert gesture.key_frames[1].angles_rad == {"HeadPitch": 0.1}


def test_naoqi_script_plays_the_motion_through_qi(wave, tmp_path, monkeypatch):
    """The script is run against a stand-in for qi that remembers what it was asked."""
    asked = []

    class Session:
        def connect(self, url):
            asked.append(url)

        def service(self, name):
            call = lambda method: lambda *arguments: asked.append((f"{name}.{method}", arguments))  # noqa: E731
            return SimpleNamespace(goToPosture=call("goToPosture"), angleInterpolation=call("angleInterpolation"))

    monkeypatch.setitem(sys.modules, "qi", SimpleNamespace(Session=Session))
    path = tmp_path / "wave.py"
    save_trajectory(wave, path)
    code = {"__name__": "script"}
    exec(compile(path.read_text(), str(path), "exec"), code)
    code["main"]("10.0.0.1")
    assert asked[0] == "tcp://10.0.0.1:9559"
    assert asked[1] == ("ALRobotPosture.goToPosture", ("StandInit", 0.5))
    call, (names, keys, times, absolute) = asked[2]
    assert call == "ALMotion.angleInterpolation"
    assert absolute is True
    assert "RElbowRoll" in names
    assert "RHand" in names
    for name, angles, at in zip(names, keys, times, strict=True):
        assert len(angles) == len(at)
        assert at[0] > 0
        assert np.abs(np.array(angles) - wave.sample(np.array(at))[:, ACTUATED.index(name)]).max() < 1e-3
    still = [name for name in ACTUATED if name not in names]
    assert np.ptp(wave.columns(still), axis=0).max() <= 1e-4


def test_writing_is_all_or_nothing(wave, tmp_path):
    with pytest.raises(GestureFileError, match=r"unknown suffix '\.bvh'"):
        save_trajectory(wave, tmp_path / "wave.bvh")
    with pytest.raises(
        GestureFileError, match=r"cannot be written \(No such file or directory\); choose another place"
    ):
        save_trajectory(wave, tmp_path / "nowhere" / "wave.csv")
    assert list(tmp_path.iterdir()) == []
    (tmp_path / "wave.csv").write_text("old")
    save_trajectory(Trajectory(wave.times[:2], wave.targets[:2]), tmp_path / "wave.csv")
    assert [path.name for path in tmp_path.iterdir()] == ["wave.csv"]
