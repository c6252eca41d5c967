"""Other people's models: said what they are, compared and driven where that can be, and never a number that was not."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from typer import Typer
from typer.testing import CliRunner

from nao_sim.cli.validate import validate
from nao_sim.robot import RobotError, model_spec
from nao_sim.robot.joints import BODY
from nao_sim.robot.others import look, read_names
from nao_sim.robot.others.names import matched
from nao_sim.robot.validation import JointReport, validate_model

HEAD = """
<mujoco model="head">
  <compiler angle="degree" autolimits="true"/>
  <option timestep="{step}" integrator="implicitfast"/>
  {assets}
  <worldbody>
    <body name="torso" pos="0 0 .3" {torso}>
      {base}
      <geom type="box" size=".05 .05 .1" mass="1"/>
      <body pos="0 0 .13">
        <joint name="{yaw}" axis="{yaw_axis}" range="{yaw_range}" armature=".01" damping=".3"/>
        <geom type="sphere" size=".01" mass=".08"/>
        <body name="skull">
          <joint name="{pitch}" axis="0 1 0" range="-39 30" armature=".01" damping=".3"/>
          {head}
        </body>
      </body>
    </body>
    {more}
  </worldbody>
  <actuator>{motors}</actuator>
</mujoco>
"""
SERVOS = '<position joint="{yaw}" kp="60" kv="1.2"/><position joint="{pitch}" kp="60" kv="1.2"/>'


def _head(folder: Path, **words: str) -> Path:
    given_ = {
        "step": "0.005", "assets": "", "torso": "", "base": "", "yaw": "HeadYaw", "yaw_axis": "0 0 1",
        "yaw_range": "-120 120", "pitch": "HeadPitch", "more": "", "motors": SERVOS,
        "head": '<geom type="sphere" size=".06" pos="0 0 .05" mass=".5"/>',
    } | words  # fmt: skip
    given_["motors"] = given_["motors"].format(**given_)
    path = folder / "theirs.xml"
    path.write_text(HEAD.format(**given_))
    return path


def _yaw(path: Path, limits: str = "thesis") -> JointReport:
    return validate_model(path, limits)[0]


def _run(*arguments: object) -> tuple[int, str]:
    app = Typer()
    app.command()(validate)
    done = CliRunner().invoke(app, ["--model", *map(str, arguments)])
    return done.exit_code, done.stdout


@pytest.mark.parametrize(
    ("yaw", "pitch"),
    [
        ("head.yaw", "head.pitch"),
        ("head_yaw_joint", "head_pitch_joint"),
        ("nao/HeadYaw", "nao/HeadPitch"),
        ("HeadYaw_a", "HeadPitch_a"),
        ("headYaw", "headPitch"),
        ("HEAD-YAW", "HEAD-PITCH"),
    ],
)
def test_joints_are_told_by_what_they_are_called(tmp_path: Path, yaw: str, pitch: str) -> None:
    report = _yaw(_head(tmp_path, yaw=yaw, pitch=pitch))
    assert report.theirs == yaw
    assert report.reached == pytest.approx((-120, 120), abs=1)
    assert not report.unmeasured


STYLES = {
    "naoqi": lambda side, words: side + "".join(word.title() for word in words),
    "dotted": lambda side, words: {"L": "left.", "R": "right.", "": ""}[side] + "_".join(words),
    "ros": lambda side, words: {"L": "l_", "R": "r_", "": ""}[side] + "_".join(words) + "_joint",
    "camel": lambda side, words: {"L": "left", "R": "right", "": ""}[side] + "".join(w.title() for w in words),
    "limb": lambda side, words: {"L": "left_arm.", "R": "right_arm.", "": ""}[side] + "_".join(words),
}


def _parted(joint: str) -> tuple[str, list[str]]:
    side, rest = (joint[0], joint[1:]) if joint[0] in "LR" else ("", joint)
    words: list[str] = []
    for letter in rest:
        if letter.isupper():
            words.append("")
        words[-1] += letter.lower()
    return side, words


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(sorted(STYLES)), st.permutations(BODY), st.integers(1, 26))
def test_whatever_the_style_each_joint_is_itself(style: str, order: list[str], count: int) -> None:
    theirs = {joint: STYLES[style](*_parted(joint)) for joint in order[:count]}
    found, _ = matched([*theirs.values(), "wheel", "left_finger_11", "camera_pan"])
    assert found == theirs


def test_a_table_tells_what_no_rule_can(tmp_path: Path) -> None:
    path = _head(tmp_path, yaw="he1", pitch="he2")
    with pytest.raises(RobotError, match=r"none of NAO's joints \(he1, he2\).*--names FILE"):
        look(path)
    table = tmp_path / "names.csv"
    table.write_text("# ours,theirs\nHeadYaw, he1\nHeadPitch,he2\n\n")
    code, said = _run("--mjcf", path, "--names", table)
    assert "by the table of names" in said
    assert "2 of NAO's 26 joints" in said
    assert code == 1


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("HeadYaw he1", "line 1: write NAOqi's name, a comma"),
        ("HeadYaw,he1\nHeadYow,he2", "line 2: NAO has no joint 'HeadYow'; did you mean 'HeadYaw'"),
        ("HeadYaw,he1\nHeadYaw,he2", "line 2: HeadYaw for the second time"),
        ("", "no names"),
    ],
)
def test_a_bad_table_of_names_is_told_by_its_line(tmp_path: Path, text: str, said: str) -> None:
    table = tmp_path / "names.csv"
    table.write_text(text)
    with pytest.raises(RobotError, match=said):
        read_names(table)
    with pytest.raises(RobotError, match="has no joint 'he9'"):
        look(_head(tmp_path), {"HeadYaw": "he9"})


UNDRIVEN = {
    '<motor joint="{yaw}" ctrlrange="-2 2"/>': ("motor", "torque"),
    '<velocity joint="{yaw}" kv="3"/>': ("velocity", "speed"),
    '<intvelocity joint="{yaw}" kp="30" actrange="-2 2"/>': ("intvelocity", "speed"),
    '<dcmotor joint="{yaw}" nominal="21.6 2.3 8.3"/>': ("dcmotor", "voltage"),
    '<dcmotor joint="{yaw}" nominal="21.6 2.3 8.3" input="pos"/>': ("dcmotor", "angles, but has no controller"),
    '<dcmotor joint="{yaw}" nominal="21.6 2.3 8.3" input="vel" controller="3 0 0 0 0 21.6"/>': ("dcmotor", "speed"),
    '<general joint="{yaw}" gainprm="5" biastype="affine" biasprm="1 -2 -1"/>': ("general", "something else"),
    '<muscle joint="{yaw}" lengthrange="0 1" range="0.7 1" force="5"/>': ("muscle", "activation"),
}


@pytest.mark.parametrize("motor", UNDRIVEN)
def test_what_takes_no_angles_is_named_and_not_measured(tmp_path: Path, motor: str) -> None:
    kind, takes = UNDRIVEN[motor]
    path = _head(tmp_path, motors=motor)
    report = _yaw(path)
    assert report.actuator == kind
    assert takes in report.unmeasured
    numbers = (report.commanded, report.reached, report.rest_mrad, report.peak_mrad, report.speed, report.torque)
    assert numbers == (None,) * 6
    assert report.compiled == pytest.approx((-120, 120))
    assert report.problems == ()
    code, said = _run("--mjcf", path)
    assert code == 1
    assert said.index(f"takes {takes}") < said.index("joint  ")
    assert "HeadYaw: not measured" in said
    assert json.loads(_run("--mjcf", path, "--json")[1])["joints"][0]["reached"] is None


DRIVEN = {
    '<position joint="{yaw}" kp="60" kv="1.2"/>': "position",
    '<general joint="{yaw}" gainprm="60" biastype="affine" biasprm="0 -60 -1.2"/>': "position",
    '<position joint="{yaw}" kp="15" kv=".3" gear="2"/>': "position",
    '<position joint="{yaw}" kp="60" kv="1.2" gear="-1"/>': "position",
    '<motor joint="{yaw}"/><position joint="{yaw}" kp="60" kv="1.2"/>': "position",
    '<dcmotor joint="{yaw}" nominal="90 9 20" input="pos" controller="60 0 1.2 0 0 90"/>': "dcmotor",
    '<dcmotor joint="{yaw}" nominal="90 9 20" input="pos vel ff" controller="60 0 1.2 0 0 90"/>': "dcmotor",
    '<pid joint="{yaw}" kp="60" kv="1.2"/>': "pid",
}


@pytest.mark.parametrize("motor", DRIVEN)
def test_what_takes_angles_is_driven_to_both_ends(tmp_path: Path, motor: str) -> None:
    report = _yaw(_head(tmp_path, motors='<velocity joint="{pitch}" kv="1"/>' + motor))
    assert report.actuator == DRIVEN[motor]
    assert report.reached == pytest.approx((-120, 120), abs=1.5)
    assert report.speed == pytest.approx(report.nominal_speed, rel=0.1)


def test_a_joint_that_counts_the_other_way_round_is_compared_and_driven_so(tmp_path: Path) -> None:
    path = _head(tmp_path, yaw_axis="0 0 -1")
    assert look(path).signs == {"HeadYaw": -1, "HeadPitch": 1}
    yaw = _yaw(path)
    assert "range differs from the documented one" not in yaw.problems
    assert yaw.reached == pytest.approx((-120, 120), abs=1)
    _, said = _run("--mjcf", path)
    assert "counted the other way round: HeadYaw" in said
    # NAO's head turns as far to both sides; its pitch does not, and is told by it.
    wrong = _head(tmp_path, yaw_axis="0 0 -1", yaw_range="-100 120")
    assert _yaw(wrong).compiled == pytest.approx((-120, 100))


def test_another_axis_is_said_and_nothing_is_driven_about_it(tmp_path: Path) -> None:
    yaw = _yaw(_head(tmp_path, yaw_axis="1 0 0"))
    assert "turns about another axis than the documented one" in yaw.problems
    assert "another axis" in yaw.unmeasured
    assert yaw.reached is None


@pytest.mark.parametrize("turn", ['euler="0 0 90"', 'euler="90 0 0"', 'euler="0 90 90"'])
def test_a_torso_that_looks_elsewhere_is_no_fault(tmp_path: Path, turn: str) -> None:
    found = look(_head(tmp_path, torso=turn))
    assert found.turned
    assert set(map(abs, found.signs.values())) == {1}


@pytest.mark.parametrize("step", ["0.001", "0.003", "0.005", "0.008", "0.012", "0.015"])
def test_simulated_time_is_followed_at_any_time_step(tmp_path: Path, step: str) -> None:
    """The joint moves at its motor's speed, whether or not the step divides the control period."""
    report = _yaw(_head(tmp_path, step=step))
    assert report.speed == pytest.approx(report.nominal_speed, rel=0.02)
    assert report.reached == pytest.approx((-120, 120), abs=1)


def test_missing_shapes_are_left_out_and_said(tmp_path: Path) -> None:
    assets = (
        '<asset><mesh name="skull" file="skull.stl"/><texture name="t" type="2d" file="t.png"/>'
        '<material name="m" texture="t"/></asset>'
    )
    shape = '<geom type="mesh" mesh="skull" material="m"/>'
    inertial = '<inertial pos="0 0 .05" mass=".5" diaginertia="1e-3 1e-3 1e-3"/>' + shape
    found = look(_head(tmp_path, assets=assets, head=inertial))
    assert found.read.missing == ("skull.stl", "t.png")
    assert found.read.weightless == ()
    assert _yaw(tmp_path / "theirs.xml").reached == pytest.approx((-120, 120), abs=1)
    # Without an <inertial> the mass was the shape's, so nothing that moves can be measured.
    path = _head(tmp_path, assets=assets, head=shape)
    assert look(path).read.weightless == ("skull",)
    yaw = _yaw(path)
    assert "masses are not known" in yaw.unmeasured
    assert yaw.reached is None
    assert "masses" in _run("--mjcf", path)[1]


def test_a_missing_include_is_named(tmp_path: Path) -> None:
    path = tmp_path / "scene.xml"
    path.write_text('<mujoco><include file="robot.xml"/></mujoco>')
    with pytest.raises(RobotError, match=r"scene\.xml is not a model .*'robot\.xml'"):
        look(path)


def test_a_ball_beside_a_free_robot_stays_a_ball(tmp_path: Path) -> None:
    ball = '<body name="ball" pos="1 0 .1"><freejoint/><geom type="sphere" size=".1"/></body>'
    found = look(_head(tmp_path, base="<freejoint/>", more=ball))
    assert found.read.base == "free"
    assert found.read.model.body("ball").pos[0] == 1
    assert look(_head(tmp_path, more=ball)).read.base == "fixed"


URDF = """<?xml version="1.0"?>
<robot name="NaoHead">
  <link name="torso"><inertial><mass value="1"/>
    <inertia ixx=".01" ixy="0" ixz="0" iyy=".01" iyz="0" izz=".01"/></inertial></link>
  <link name="Neck"><inertial><mass value=".1"/>
    <inertia ixx=".001" ixy="0" ixz="0" iyy=".001" iyz="0" izz=".001"/></inertial>
    <collision><geometry><mesh filename="package://nao_meshes/HeadYaw.dae"/></geometry></collision></link>
  <joint name="HeadYaw" type="revolute"><parent link="torso"/><child link="Neck"/><origin xyz="0 0 0.1265"/>
    <axis xyz="0 0 1"/><limit effort="1.547" lower="-2.08567" upper="2.08567" velocity="8.26797"/></joint>
</robot>"""


def test_a_urdf_is_compared_and_not_driven(tmp_path: Path) -> None:
    path = tmp_path / "nao.urdf"
    path.write_text(URDF)
    yaw = _yaw(path, "v5")
    assert (yaw.problems, yaw.unmeasured) == (("no motor",), "nothing drives it")
    code, said = _run("--mjcf", path, "--limits", "v5")
    assert code == 1
    assert "URDF 'NaoHead'" in said
    assert "1 as 'v5'" in said
    assert "package://nao_meshes/HeadYaw.dae" in said


@pytest.mark.filterwarnings("ignore:.*conflict")
def test_our_own_model_attached_in_somebody_s_scene_keeps_its_limits(tmp_path: Path) -> None:
    """Written out by MuJoCo with a prefix, the motors come back as general actuators."""
    scene = mujoco.MjSpec.from_string('<mujoco><compiler conflict="merge"/></mujoco>')
    scene.attach(model_spec(scene=False, fingers=False), frame=scene.worldbody.add_frame(), prefix="his_")
    path = tmp_path / "scene.xml"
    scene.compile()
    path.write_text(scene.to_xml())
    found = look(path)
    assert len(found.theirs) == 26
    assert "'his_' before them" in found.how
    assert found.sets["thesis"] == 26
    reports = validate_model(path)
    assert [r.joint for r in reports if r.problems or r.unmeasured] == []
