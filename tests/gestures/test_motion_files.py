"""Formats that NAO people have: every one is read to the same keys, or refused in words that help."""

import json
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from scipy.interpolate import BPoly

from nao_sim.gestures import GestureError, GestureFileError, load_gesture
from nao_sim.gestures.formats import WRITERS, holds_a_motion, load_motion, said, save_curves
from nao_sim.motion.curves import Curve
from nao_sim.robot import joint_table

POSES = [(0.5, 0.2, -0.1), (1.5, -0.4, 0.3)]


def near(pairs):
    """Return keys to compare with, times and angles to a millionth."""
    return [pytest.approx(pair, abs=1e-6) for pair in pairs]


def keys(motion, joint="HeadYaw"):
    curve = motion.curves[joint]
    return list(zip(curve.times.round(6).tolist(), curve.values.round(6).tolist(), strict=True))


WANTED = [(0.5, 0.2), (1.5, -0.4)]
DEG = [(time, np.rad2deg(yaw), np.rad2deg(pitch)) for time, yaw, pitch in POSES]


def table(header, rows, sign=",", decimal="."):
    lines = [sign.join(f"{value:.8g}".replace(".", decimal) for value in row) for row in rows]
    return "\n".join([header, *lines, ""])


TABLES = {
    "suffixes": table("time_s,HeadYaw_rad,HeadPitch_rad", POSES),
    "brackets": table("time [s],HeadYaw (rad),HeadPitch (rad)", POSES),
    "degrees": table("t,HeadYaw_deg,HeadPitch [degrees]", DEG),
    "milliseconds": table("time_ms,HeadYaw_rad,HeadPitch_rad", [(1e3 * t, a, b) for t, a, b in POSES]),
    "microseconds": table("timestamp (µs),HeadYaw_rad,HeadPitch_rad", [(1e6 * t, a, b) for t, a, b in POSES]),
    "semicolons": table("time_s;HeadYaw_rad;HeadPitch_rad", POSES, ";", ","),
    "tabs": table("time_s\tHeadYaw_rad\tHeadPitch_rad", POSES, "\t"),
    "blanks": table("time_s HeadYaw_rad HeadPitch_rad", POSES, " "),
    "mark": "\ufeff" + table("time_s,HeadYaw_rad,HeadPitch_rad", POSES),
    "trailing": table("time_s,HeadYaw_rad,HeadPitch_rad,", POSES).replace("\n", ",\n"),
    "comments": "# recorded\n" + table("time_s,HeadYaw_rad,HeadPitch_rad", POSES) + "# end\n\n",
    "hash header": table("# time_s,HeadYaw_rad,HeadPitch_rad", POSES),
    "units line": table("time,HeadYaw,HeadPitch\ns,rad,rad", POSES),
    "index": "\n".join([",time_s,HeadYaw_rad", "0,0.5,0.2", "1,1.5,-0.4"]),
    "excel": "sep=;\r\n" + table("time_s;HeadYaw_rad;HeadPitch_rad", POSES, ";", ",").replace("\n", "\r\n"),
}


@pytest.mark.parametrize("name", TABLES)
def test_tables_are_read_as_their_headers_say(name, write):
    assert keys(load_motion(write(TABLES[name], "a.csv"))) == near(WANTED)


def test_what_the_header_does_not_say_a_person_may(write):
    bare = table("time,HeadYaw,HeadPitch", POSES)
    assert keys(load_motion(write(bare, "a.csv"), said("rad"))) == WANTED
    frames = table("frame,HeadYaw_rad,HeadPitch_rad", [(10, *POSES[0][1:]), (30, *POSES[1][1:])])
    assert keys(load_motion(write(frames, "b.csv"), said("frames@20"))) == WANTED
    clock = "time,HeadYaw_rad\n1700000000.5,0.2\n1700000001.5,-0.4\n"
    assert keys(load_motion(write(clock, "c.csv"), said("clock"))) == [(0.0, 0.2), (1.0, -0.4)]
    with pytest.raises(GestureError, match="a second unit"):
        said("rad,deg")
    with pytest.raises(GestureError, match=r"'fot' is no unit"):
        said("fot")


@settings(max_examples=40, deadline=None)
@given(
    scale=st.sampled_from([1e3, 1e6, 1e9]),
    period=st.sampled_from([0.01, 0.012, 0.02, 0.033, 0.04, 0.1]),
    rows=st.integers(2, 60),
)
def test_times_in_another_unit_never_pass_as_seconds(scale, period, rows, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "scaled.csv"
    lines = [f"{index * period * scale:.6f},{0.1 * np.sin(index * period):.6f}" for index in range(rows)]
    path.write_text("\n".join(["time,HeadYaw_rad", *lines]))
    with pytest.raises(GestureFileError, match=r"times are seconds|starts at"):
        load_motion(path)


@settings(max_examples=40, deadline=None)
@given(most=st.floats(0.01, 3.2), count=st.integers(1, 5))
def test_angles_without_a_unit_that_may_be_radians_are_refused(most, count, tmp_path_factory):
    path = tmp_path_factory.getbasetemp() / "bare.csv"
    joints = ["HeadYaw", "RElbowYaw", "LElbowYaw", "RShoulderPitch", "LWristYaw"][:count]
    path.write_text("\n".join([",".join(["time_s", *joints]), ",".join(["1", *[f"{most:.6f}"] * count])]))
    with pytest.raises(GestureFileError, match=r"no unit.*_rad' or"):
        load_motion(path)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.csv", "time_s,HeadYaw_turns\n1,0.1\n", r"line 1, column 2: unknown joint 'HeadYaw_turns'"),
        ("a.csv", "time_s,HeadYaw (turns)\n1,0.1\n", r"line 1, column 2: unit 'turns' of HeadYaw is not known"),
        ("a.csv", "time (fortnights),HeadYaw_rad\n1,0.1\n", "times have the unit 'fortnights'"),
        ("a.csv", "frames,HeadYaw_rad\n1,0.1\n", r"line 1, the column of frames.*--units frames@25"),
        ("a.csv", "time_s,HeadYaw_rad\n1,0.1,7\n", r"line 2 has 3 cells, the header \(line 1\) has 2"),
        ("a.csv", "time_s,HeadYaw_rad\n1,0.1\n,0.2\n", "line 3, column 1: has no time"),
        ("a.csv", "time_s,HeadYaw_rad\n1,1_0\n", r"line 2, column 2 \(HeadYaw_rad\): '1_0' is not a number"),
        ("a.csv", "time_s,HeadYaw_rad\n1,0.1\n1,0.2\n", "line 3 is at 1 s, not after 1 s"),
        ("a.csv", "time_s,time_ms,HeadYaw_rad\n1,1,0\n", "column 2: a second column of times"),
        ("a.csv", "time,HeadYaw_rad\n1700000000,0.1\n1700000001,0.1\n", r"times of a clock \(2023-11-14"),
        ("a.csv", "time_s,HeadYaw_rad\n1,0.1\n5940,0.1\n", r"lasts 99 minutes.*--longest"),
        ("a.csv", "time,HeadYaw_rad\n812.4,0.1\n812.5,0.2\n", "starts at 812.4 s"),
        ("a.motion", "#WEBOTS_MOTION,V2.0,HeadYaw\n00:00:500,a,0\n", "version 'V2.0' is not known"),
        ("a.motion", "#WEBOTS_MOTION,V1.0,HeadYaw\n00:01:000,a,0\n99:00:000,b,0\n", "lasts 99 minutes"),
        ("a.motion", "#WEBOTS_MOTION,V1.0,HeadYaw,HeadYaw\n00:00:500,a,0,0\n", "a second column for HeadYaw"),
        ("a.pos", "0 0 1\n", "line 1 has 3 numbers; a pose has 25 joints and a duration"),
        ("a.pos", " ".join(["x"] + ["0"] * 25), "line 1, column 1: 'x' is not a number"),
        ("a.json", '{"initial_positions": {},\n "motion" []}', r"line 2, column 11: is not JSON"),
        ("a.json", '{"a": 1}', "is it a HULKs motion"),
        (
            "a.json",
            '{"initial_positions": {}, "motion": [{"keyframes": '
            '[{"duration": 1, "positions": {"head": {"jaw": 1}}}]}]}',
            r"motion\[0\].keyframes\[0\].positions.head.jaw: unknown joint 'HeadJaw'",
        ),
        ("a.py", "print('hello')\n", "has no lists names, times and keys"),
        ("a.py", "names = ['HeadYaw']\ntimes = [[1.0]]\nkeys = [[0.1, 0.2]]\n", "times and keys of one length"),
        ("a.xar", "<ChoregrapheProject>", r"line 1, column \d+: is not XML"),
        ("a.xar", "<ChoregrapheProject/>", "has no time line"),
        ("a.xar", "<!DOCTYPE a [<!ENTITY b 'c'>]><a>&b;</a>", "has a document type"),
    ],
)
def test_refused_with_the_place_and_the_mend(write, name, text, message):
    with pytest.raises(GestureFileError, match=message):
        load_motion(write(text, name))


def test_webots_motions_as_people_have_them(write):
    v11 = "#WEBOTS_MOTION,V1.1,HeadYaw, HeadPitch,\n00:00:500,a,0.2,*,\n\n00:01:500,b, -0.4 ,0.3,\n"
    motion = load_motion(write(v11, "a.motion"))
    assert keys(motion) == WANTED
    assert keys(motion, "HeadPitch") == [(1.5, 0.3)]
    assert motion.notes == ("line 3 is empty; Webots ends the motion there, we read on",)
    league = "#WEBOTS_MOTION,V1.1\nHeadYaw%HeadPitch\nplay%0.2%-0.1%0.5\nplay%-0.4%0.3%1.0\n"
    assert keys(load_motion(write(league, "b.motion"))) == WANTED
    second = "#WEBOTS_MOTION,V1.0\nHeadYaw,HeadPitch\n500,a,0.2,-0.1\n1:500,b,-0.4,0.3\n"
    assert keys(load_motion(write(second, "c.motion"))) == WANTED


EXPORT = """# Choregraphe bezier export in Python.
from naoqi import ALProxy
names = list()
times = list()
keys = list()

names.append("HeadYaw")
times.append([0.5, 1.5])
keys.append([[0.2, [3, -0.18, 0], [3, 0.333333, 0.1]], [-0.4, [3, -0.333333, 0.05], [3, 0, 0]]])

names.append("HeadPitch")
times.append([1.5])
keys.append([0.3])

try:
  motion = ALProxy("ALMotion")
  motion.angleInterpolationBezier(names, times, keys)
except BaseException, err:
  print err
"""


def test_choregraphe_s_python_export_is_parsed_and_its_curves_are_bezier(write):
    motion = load_motion(write(EXPORT, "a.py"))
    assert keys(motion) == WANTED
    straight = motion.curves["HeadYaw"].straight()
    # The same cubic, with time and angle as polynomials of one parameter, from SciPy.
    share = np.linspace(0, 1, 2001)
    at = BPoly([[0.5], [0.833333], [1.166667], [1.5]], [0, 1])(share)
    expected = BPoly([[0.2], [0.3], [-0.35], [-0.4]], [0, 1])(share)
    assert np.abs(np.interp(straight.times, at, expected) - straight.values).max() < 1e-4
    assert np.diff(straight.times).max() <= 0.02 + 1e-9


@pytest.mark.parametrize(
    "text",
    [
        EXPORT.replace("BaseException, err", "BaseException as err").replace("print err", "print(err)"),
        "NAMES = ['HeadYaw']\nTIMES = [[0.5, 1.5]]\nKEYS = [[0.2, -0.4]]\n",
        "class A:\n    def __init__(self):\n        self.names = []\n        self.times = []\n        self.keys = []\n"
        "        self.names.append('HeadYaw')\n        self.times.append([0.5, 1.5])\n"
        "        self.keys.append([0.2, -0.4])\n",
        "import almath\nmotion.angleInterpolation('HeadYaw', [2 * 0.1, -0.4 + 0 * almath.TO_RAD], [0.5, 1.5], True)\n",
        "def wave(proxy):\n  names = ['HeadYaw']\n  angleLists = [[0.1 + 0.1, -0.4]]\n  timeLists = [[0.5, 1.5]]\n"
        "  proxy.angleInterpolation(names, angleLists, timeLists, True)\n",
    ],
    ids=["python 3", "ours", "class", "call", "function"],
)
def test_scripts_people_have(write, text):
    assert keys(load_motion(write(text, "a.py"))) == WANTED


def test_scripts_are_never_run_and_several_motions_are_chosen_from(write, tmp_path):
    evil = f"open({str(tmp_path / 'ran')!r}, 'w')\nnames = [__import__('os').getcwd()]\n" + EXPORT
    assert keys(load_motion(write(evil, "a.py"))) == WANTED
    assert not (tmp_path / "ran").exists()
    one = "def {0}():\n    names = ['HeadYaw']\n    times = [[0.5, 1.5]]\n    keys = [[0.2, {1}]]\n"
    both = write(one.format("nod", -0.4) + one.format("shake", 0.4), "b.py")
    with pytest.raises(GestureFileError, match=r"holds 2 motions; choose one with --part: 1 \(nod\), 2 \(shake\)"):
        load_motion(both)
    assert keys(load_motion(both, said(part="nod"))) == WANTED
    assert keys(load_motion(both, said(part="2")))[1] == (1.5, 0.4)


XAR = """<?xml version="1.0" encoding="UTF-8" ?>
<ChoregrapheProject xmlns="http://www.aldebaran-robotics.com/schema/choregraphe/project.xsd" xar_version="3">
<Box name="root"><Timeline enable="0"><BehaviorLayer><Box name="Hello"><Timeline enable="1" fps="{fps}" size="50">
<ActuatorList model=""><ActuatorCurve actuator="HeadYaw" mute="0" unit="0">
<Key frame="{a}" value="11.4591559">
<Tangent side="right" interpType="bezier" abscissaParam="2" ordinateParam="0"/></Key>
<Key frame="{b}" value="-22.9183118" /></ActuatorCurve>
<ActuatorCurve actuator="LHand" mute="0" unit="1"><Key frame="{a}" value="0.5" /></ActuatorCurve>
<ActuatorCurve actuator="RHand" mute="1" unit="1"><Key frame="{a}" value="0.5" /></ActuatorCurve>
</ActuatorList></Timeline></Box></BehaviorLayer></Timeline></Box></ChoregrapheProject>"""


@pytest.mark.parametrize("fps", [20, 30, 50])
def test_choregraphe_s_time_lines(write, tmp_path, fps):
    motion = load_motion(write(XAR.format(fps=fps, a=fps // 2, b=3 * fps // 2), "behavior.xar"))
    assert keys(motion) == near(WANTED)
    assert keys(motion, "LHand") == [(0.5, 0.5)]
    assert "RHand" not in motion.curves
    assert any("RHand is muted" in note for note in motion.notes)
    assert motion.curves["HeadYaw"].handles[0, 1, 0] == pytest.approx(2 / fps)
    project = '<Package><BehaviorDescription src="{}" xar="behavior.xar"/></Package>'
    assert keys(load_motion(write(project.format("."), "p.pml"))) == near(WANTED)
    with pytest.raises(GestureFileError, match="outside its folder"):
        load_motion(write(project.format("../.."), "q.pml"))
    animation = (
        '<Animation typeVersion="2.0"><ActuatorCurve fps="20.0" actuator="HeadYaw" mute="false" unit="radian">'
        '<Key frame="10.0" value="0.2"/><Key frame="30.0" value="-0.4"/></ActuatorCurve></Animation>'
    )
    assert keys(load_motion(write(animation, "a.xml"))) == WANTED
    with pytest.raises(GestureFileError, match="no unit"):
        load_motion(write(animation.replace('unit="radian"', 'unit="-1"'), "b.xml"))


def test_team_formats(write):
    head = ["0"] * 23
    pos = "# HY HP ... DUR\n" + " ".join(["11.4591559", "0", *head, "500"]) + "\n$ " + " ".join(["1"] * 25)
    pos += "\n\n" + " ".join(["-22.9183118", "0", *head, "1000"]) + "  # end\n"
    motion = load_motion(write(pos, "a.pos"))
    assert keys(motion) == near(WANTED)
    assert motion.notes == ("stiffness ($) is not carried over",)
    frame = {"duration": 1.0, "positions": {"head": {"yaw": -0.4, "pitch": None}}}
    hulks = {
        "initial_positions": {"head": {"yaw": 0.2}},
        "motion": [{"keyframes": [frame], "exit_condition": {"A": 1}}],
    }
    motion = load_motion(write(json.dumps(hulks), "a.json"))
    assert keys(motion) == [(0.0, 0.2), (1.0, -0.4)]
    assert motion.notes == ("conditions to go on or to stop are not carried over",)
    old = {"initial_positions": {"head": {"yaw": 0.2}}, "frames": [frame | {"duration": {"secs": 1, "nanos": 0}}]}
    assert keys(load_motion(write(json.dumps(old), "b.json"))) == [(0.0, 0.2), (1.0, -0.4)]


def test_lerobot_s_episodes(tmp_path):
    import pyarrow as pa
    import pyarrow.parquet as pq

    (tmp_path / "meta").mkdir()
    (tmp_path / "data").mkdir()
    names = {"action": {"names": {"motors": ["HeadYaw_rad", "HeadPitch_rad", "base_x"]}}}
    (tmp_path / "meta" / "info.json").write_text(json.dumps({"features": names}))
    path = tmp_path / "data" / "file-000.parquet"
    rows = {
        "action": [[0.2, 0.1, 9.0], [-0.4, 0.1, 9.0], [0.1, 0.0, 9.0]],
        "timestamp": [0.0, 1.0, 0.0],
        "episode_index": [0, 0, 1],
    }
    pq.write_table(pa.table(rows), path)
    with pytest.raises(GestureFileError, match="holds 2 episodes"):
        load_motion(path)
    motion = load_motion(path, said(part="0"))
    assert keys(motion) == [(0.0, 0.2), (1.0, -0.4)]
    assert motion.notes == ("'action' is read", "1 numbers that are no joint angles are left out")


ANGLES = {
    name: tuple(joint_table().select([name]).range_rad("envelope")[0]) for name in ("HeadYaw", "LElbowRoll", "RHand")
}


@st.composite
def motions(draw):
    """Some joints with keys of their own on the 40 ms grid that every format can hold."""
    curves = {}
    for name in draw(st.lists(st.sampled_from(sorted(ANGLES)), min_size=1, unique=True)):
        frames = sorted(draw(st.sets(st.integers(1, 100), min_size=1, max_size=6)))
        low, high = ANGLES[name]
        values = [draw(st.floats(low, high)) for _ in frames]
        curves[name] = Curve(np.array(frames) * 0.04, np.array(values))
    return curves


@pytest.mark.parametrize("suffix", WRITERS)
@settings(max_examples=15, suppress_health_check=[HealthCheck.function_scoped_fixture], deadline=None)
@given(curves=motions())
def test_what_is_written_is_read_back(suffix, curves, tmp_path):
    path = tmp_path / f"motion{suffix}"
    save_curves(curves, path)
    if suffix == ".toml":
        frames = load_gesture(path).key_frames
        back = {
            name: Curve(*np.array([(f.time_s, f.angles_rad[name]) for f in frames if name in f.angles_rad]).T)
            for name in curves
        }
    else:
        back = load_motion(path).curves
    if suffix not in (".py", ".toml"):
        assert holds_a_motion(path)
    first = min(curve.times[0] for curve in curves.values()) if suffix == ".json" else 0.0
    for name, curve in curves.items():
        at = np.linspace(curve.times[0], curve.times[-1], 50)
        there = np.interp(at - first, back[name].times, back[name].values)
        assert np.abs(there - np.interp(at, curve.times, curve.values)).max() < 2e-5


def test_what_is_no_recording_or_no_table_is_said_so(tmp_path):
    (tmp_path / "a.rrd").write_bytes(b"RRF2 and nothing else")
    (tmp_path / "a.parquet").write_text("no")
    with pytest.raises(GestureFileError, match="is not a Rerun recording"):
        load_motion(tmp_path / "a.rrd")
    with pytest.raises(GestureFileError, match="is read, not written"):
        save_curves({"HeadYaw": Curve(np.array([1.0]), np.array([0.0]))}, tmp_path / "b.rrd")
    with pytest.raises(GestureFileError, match="is not a Parquet table"):
        load_motion(Path(tmp_path / "a.parquet"))
