"""Limits are hard: every joint to both ends, ours and in somebody else's model."""

from __future__ import annotations

import json
from pathlib import Path

import mujoco
import pytest
from typer.testing import CliRunner

from nao_sim.robot import ACTUATED, Nao, joint_table
from nao_sim.robot.range_figure import draw_ranges
from nao_sim.robot.tolerance import SOFTNESS_RAD
from nao_sim.robot.validation import PEAK_MRAD, REST_MRAD, SPEED_RATIO, JointReport, validate_model


@pytest.fixture(scope="module")
def reports() -> list[JointReport]:
    return validate_model()


def test_every_joint_keeps_its_limits(reports: list[JointReport]) -> None:
    assert [r.joint for r in reports if r.problems] == []
    assert len(reports) == 26
    for report in reports:
        assert report.rest_mrad is not None
        assert report.rest_mrad <= REST_MRAD
        assert report.peak_mrad <= min(PEAK_MRAD, 1e3 * SOFTNESS_RAD)
        assert report.speed <= SPEED_RATIO * report.nominal_speed
        assert report.torque <= report.torque_limit * (1 + 1e-9)


def test_commanded_ends_are_the_documented_ones(reports: list[JointReport]) -> None:
    cut_by_tables = {"HeadPitch", "LAnkleRoll", "RAnkleRoll"}
    for report in reports:
        low, high = report.documented
        assert report.commanded[0] >= low
        assert report.commanded[1] <= high
        if report.joint not in cut_by_tables:
            assert report.commanded == pytest.approx(report.documented, abs=1e-9)


def test_v5_limits_hold_too() -> None:
    found = validate_model(limits="v5")
    assert [r.joint for r in found if r.problems] == []
    assert max(r.peak_mrad for r in found) <= 1e3 * SOFTNESS_RAD


@pytest.mark.parametrize("name", ["LShoulderPitch", "LElbowRoll", "RHipRoll", "LKneePitch", "RWristYaw", "LHand"])
def test_targets_past_both_ends_by_raw_control_are_clamped(name: str, hung: Nao) -> None:
    """Even without our command layer the compiled control range holds, and the stop carries what the motor pushes."""
    model, joint = hung.model, hung.model.joint(name)
    for sign, end in ((-1, 0), (1, 1)):
        hung.reset("StandZero")
        data = hung.data
        data.ctrl[ACTUATED.index(name)] = sign * 10
        mujoco.mj_step(model, data, 500)
        past = sign * (data.joint(name).qpos[0] - joint.range[end])
        assert past <= REST_MRAD * 1e-3


def test_the_stop_pushes_back_with_what_the_motor_gives(hung: Nao) -> None:
    """Pushed into its stop at full torque, a joint rests within 1 mrad and the stop's force balances the motor's."""
    model = hung.model
    name, row = "LElbowYaw", ACTUATED.index("LElbowYaw")
    hung.reset("StandZero")
    data = hung.data
    clamp = int(mujoco.mjtDisableBit.mjDSBL_CLAMPCTRL)
    model.opt.disableflags |= clamp
    try:
        data.ctrl[row] = 4.0
        mujoco.mj_step(model, data, 750)
        dof = model.joint(name).dofadr[0]
        assert data.actuator_force[row] == pytest.approx(joint_table()[name].effort_nm, rel=1e-6)
        assert data.qpos[model.joint(name).qposadr[0]] - model.joint(name).range[1] <= 1e-3
        balance = data.qfrc_actuator[dof] + data.qfrc_constraint[dof] - data.qfrc_bias[dof]
        assert balance == pytest.approx(0, abs=1e-3)
        assert data.qfrc_constraint[dof] < -1.0
    finally:
        model.opt.disableflags &= ~clamp


_SOMEBODYS = """
<mujoco>
  <worldbody>
    <body name="base" pos="0 0 0.3">
      <freejoint/>
      <geom size="0.05" mass="1"/>
      <body>
        <joint name="HeadYaw" axis="0 0 1" range="{low} {high}" armature="0.002" damping="{damping}"/>
        <geom size="0.04" mass="0.5"/>
        <body>
          <joint name="HeadPitch" axis="0 1 0" range="-38.5 29.5" armature="0.002" damping="0.1"/>
          <geom size="0.04" mass="0.1" pos="0 0 0.05"/>
        </body>
      </body>
    </body>
  </worldbody>
  <actuator><position joint="HeadYaw" kp="{kp}"/></actuator>
</mujoco>
"""


def _somebodys(
    path: Path, low: float = -120, high: float = 120, damping: float = 0.3, kp: float = 15
) -> list[JointReport]:
    path.write_text(_SOMEBODYS.format(low=low, high=high, damping=damping, kp=kp))
    return validate_model(path)


def test_somebody_elses_model_is_measured_the_same_way(tmp_path: Path) -> None:
    yaw, pitch, *others = _somebodys(tmp_path / "theirs.xml")
    assert "range differs from the documented one" not in yaw.problems
    assert yaw.reached == pytest.approx((-120, 120), abs=1)
    assert pitch.problems == ("range differs from the documented one", "no motor")
    assert {r.problems for r in others} == {("no such joint, or no range",)}


def test_a_wrong_range_and_a_weak_motor_are_found(tmp_path: Path) -> None:
    yaw = _somebodys(tmp_path / "narrow.xml", low=-90)[0]
    assert "range differs from the documented one" in yaw.problems
    assert "does not reach the end it was sent to" in yaw.problems
    weak = _somebodys(tmp_path / "weak.xml", kp=0.01)[0]
    assert weak.problems == ("does not reach the end it was sent to",)


def test_validate_command(tmp_path: Path, reports: list[JointReport], monkeypatch: pytest.MonkeyPatch) -> None:
    import typer

    from nao_sim.cli.validate import validate

    app = typer.Typer()
    app.command()(validate)
    theirs = tmp_path / "theirs.xml"
    theirs.write_text(_SOMEBODYS.format(low=-120, high=120, damping=0.3, kp=15))
    bad = CliRunner().invoke(app, ["--model", "--mjcf", str(theirs), "--json"])
    assert bad.exit_code == 1
    assert json.loads(bad.stdout)["valid"] is False
    monkeypatch.setattr("nao_sim.robot.validation.validate_model", lambda mjcf, limits: reports)
    figure = tmp_path / "ranges.png"
    good = CliRunner().invoke(app, ["--model", "--figure", str(figure)])
    assert good.exit_code == 0
    assert "26 joints, 0 with problems" in good.stdout
    assert figure.stat().st_size > 5000


def test_a_picture_of_unknown_kind_is_refused(tmp_path: Path, reports: list[JointReport]) -> None:
    from nao_sim.errors import NaoSimError

    with pytest.raises(NaoSimError, match="picture format"):
        draw_ranges(reports, tmp_path / "ranges.xyz", "")


def test_what_is_no_model_is_refused(tmp_path: Path) -> None:
    from nao_sim.robot import RobotError

    empty = tmp_path / "empty.xml"
    empty.write_text("")
    for path in (empty, tmp_path / "missing.xml", tmp_path):
        with pytest.raises(RobotError, match=path.name):
            validate_model(path)
