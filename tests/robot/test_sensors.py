"""What the robot feels."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest

from nao_sim.robot import Nao, model_spec
from nao_sim.robot.sensors import BUMPERS, FSR, TOUCH, roll_pitch_yaw

WEIGHT_N = 5.30535 * 9.81


@pytest.mark.parametrize("name", ["StandZero", "Stand", "StandInit", "Crouch"])
def test_eight_foot_sensors_carry_the_weight(name: str, standing: Nao) -> None:
    standing.reset(name)
    standing.step(150)
    forces = standing.sensors().fsr
    assert forces.shape == (8,)
    assert forces.sum() == pytest.approx(WEIGHT_N, rel=0.02)
    assert forces[:4].sum() == pytest.approx(WEIGHT_N / 2, rel=0.1)
    assert (standing.fsr == forces).all()


def test_leaning_forward_loads_the_toes(standing: Nao) -> None:
    def front(lean: float) -> float:
        standing.reset("StandInit")
        ankles = ["LAnklePitch", "RAnklePitch"]
        standing.set_angles(ankles, standing.targets[12] - lean)
        standing.step(100)
        by_name = dict(zip(FSR, standing.fsr, strict=True))
        return sum(force for name, force in by_name.items() if name[-2] == "F")

    assert front(0.04) > front(0.0) + 2 > front(-0.04) + 4


def test_at_rest_the_accelerometer_feels_gravity_in_the_torso_frame(standing: Nao) -> None:
    standing.reset("StandInit")
    standing.step(150)
    seen = standing.sensors()
    pitch = seen.torso_rpy[1]
    assert pitch == pytest.approx(np.radians(5.73), abs=0.01)
    assert seen.accel == pytest.approx([-9.81 * np.sin(pitch), 0, 9.81 * np.cos(pitch)], abs=0.02)
    assert seen.gyro == pytest.approx([0, 0, 0], abs=1e-3)


def test_gyrometer_is_the_rate_of_the_orientation(standing: Nao) -> None:
    standing.reset("StandZero")
    standing.set_angles(["LHipPitch", "RHipPitch"], -0.4)
    standing.step(6)
    before = standing.sensors()
    standing.step(1)
    after = standing.sensors()
    rate = (after.torso_rpy[1] - before.torso_rpy[1]) / 0.02
    assert rate > 0.5
    assert (before.gyro[1] + after.gyro[1]) / 2 == pytest.approx(rate, rel=0.1)


@pytest.mark.parametrize("seed", range(5))
def test_roll_pitch_yaw_rebuild_the_rotation(seed: int) -> None:
    quat = np.random.default_rng(seed).normal(size=4)
    quat /= np.linalg.norm(quat)
    roll, pitch, yaw = roll_pitch_yaw(quat)
    cr, sr, cp, sp, cy, sy = (f(a) for a in (roll, pitch, yaw) for f in (np.cos, np.sin))
    rotation = (
        np.array([[cy, -sy, 0], [sy, cy, 0], [0, 0, 1]])
        @ np.array([[cp, 0, sp], [0, 1, 0], [-sp, 0, cp]])
        @ np.array([[1, 0, 0], [0, cr, -sr], [0, sr, cr]])
    )
    expected = np.zeros(9)
    mujoco.mju_quat2Mat(expected, quat)
    assert rotation.ravel() == pytest.approx(expected, abs=1e-9)


def test_standing_free_nothing_is_touched(standing: Nao) -> None:
    standing.reset("StandInit")
    standing.step(20)
    seen = standing.sensors()
    assert set(seen.bumpers) == set(BUMPERS)
    assert set(seen.touch) == set(TOUCH)
    assert not any(seen.bumpers.values())
    assert not any(seen.touch.values())


def _with_box(size: list[float], pos: list[float], name: str = "obstacle", **variant: str) -> Nao:
    spec = model_spec(**variant)
    spec.worldbody.add_geom(name=name, type=mujoco.mjtGeom.mjGEOM_BOX, size=size, pos=pos)
    return Nao(model=spec.compile(), posture="StandZero")


def test_a_wall_at_the_toes_presses_the_bumpers() -> None:
    nao = _with_box([0.05, 0.5, 0.2], [0.1497 + 0.0005, 0, 0.2])
    nao.step(5)
    assert not any(nao.sensors().bumpers.values())
    nao.data.qvel[0] = 0.3
    nao.step(4)
    assert all(nao.sensors().bumpers.values())


def test_a_hand_on_the_head_is_felt() -> None:
    nao = _with_box([0.02, 0.02, 0.02], [0.0, 0, 0.5 + 0.1265 + 0.114 + 0.018], base="fixed")
    nao.step(2)
    touched = [name for name, on in nao.sensors().touch.items() if on]
    assert touched == ["HeadTouchMiddle"]


@pytest.mark.parametrize(
    ("name", "offset"),
    [("Back", (0.042, 0, 0.022)), ("Left", (0.042, 0.022, 0)), ("Right", (0.042, -0.022, 0))],
)
def test_a_finger_on_the_hand_is_felt_where_it_is(name: str, offset: tuple[float, float, float], hung: Nao) -> None:
    hung.reset("StandZero")
    hand = hung.data.body("l_hand")
    away = np.sign(offset) * [0, 1, 1] * 0.017
    nao = _with_box([0.01, 0.02, 0.02], list(hand.xpos + hand.xmat.reshape(3, 3) @ (offset + away)), base="fixed")
    assert [sensor for sensor, on in nao.sensors().touch.items() if on] == [f"LHandTouch{name}"]


@pytest.mark.parametrize("distance", [0.4, 0.8])
def test_sonars_hear_a_wall_ahead(distance: float) -> None:
    nao = _with_box([0.02, 1.5, 1.0], [0.0537 + distance + 0.02, 0, 1.0])
    echo = nao.sensors().sonar
    assert echo["Left"] == pytest.approx(echo["Right"], rel=0.02)
    # The beam is aimed outwards and up, but its cone still reaches straight ahead.
    assert distance <= echo["Left"] < 1.06 * distance


def test_sonar_tells_left_from_right_and_keeps_its_range() -> None:
    nao = _with_box([0.02, 0.2, 0.3], [0.6, 0.35, 0.4], base="fixed")
    echo = nao.sensors().sonar
    assert echo["Left"] < 0.8
    assert echo["Right"] > echo["Left"] + 0.05
    empty = Nao(model=model_spec(scene=False).compile())
    assert set(empty.sensors().sonar.values()) == {3.0}


def test_readings_are_copies(standing: Nao) -> None:
    standing.reset("StandInit")
    standing.step(2)
    seen = standing.sensors()
    kept = [standing.torques, standing.angles, standing.velocities, standing.targets, seen.fsr, seen.gyro]
    before = [values.copy() for values in kept]
    standing.set_angles("Body", 0.0)
    standing.step(10)
    assert all((a == b).all() for a, b in zip(kept, before, strict=True))


def test_holding_a_straight_arm_costs_what_statics_says(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.step(150)
    # 0.54 Nm, computed apart from this model for the same masses.
    assert abs(hung.torques[2]) == pytest.approx(0.54, abs=0.02)
    assert np.abs(hung.velocities).max() < 1e-3
