"""The robot on its feet and off them: holds, stability, determinism, falls."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.stats import qmc

from nao_sim.robot import ACTUATED, Nao, UnstableError, joint_table, model_spec

LOW, HIGH = joint_table().select(ACTUATED).range_rad().T


def _angle_deg(a: np.ndarray, b: np.ndarray) -> float:
    return float(2 * np.degrees(np.arccos(min(1.0, abs(a[3:] @ b[3:])))))


@pytest.mark.slow
@pytest.mark.parametrize("name", ["StandZero", "Stand", "StandInit", "Crouch"])
def test_official_stands_hold_a_minute(name: str) -> None:
    """No sole slides 1 mm and the torso never tilts 0.5 degrees from where the posture puts it."""
    nao = Nao(posture=name, fingers=False)
    start, soles = nao.torso_pose, _soles(nao)
    for _ in range(60):
        nao.step(50)
        assert np.linalg.norm((_soles(nao) - soles)[:, :2], axis=1).max() < 1e-3
        assert _angle_deg(start, nao.torso_pose) < 0.5
        assert not nao.fallen
    assert np.abs(nao.velocities).max() < 5e-3


def _soles(nao: Nao) -> np.ndarray:
    return np.array([nao.data.site(name).xpos for name in ("l_sole", "r_sole")])


@pytest.mark.parametrize("name", ["Sit", "SitRelax", "LyingBelly", "LyingBack"])
def test_sitting_and_lying_come_to_rest(name: str, standing: Nao) -> None:
    standing.reset(name)
    standing.step(150)
    rest = standing.torso_pose
    standing.step(150)
    assert np.abs(standing.torso_pose - rest)[:3].max() < 1e-4
    assert _angle_deg(standing.torso_pose, rest) < 0.05
    # It lies by design: that is not a fall.
    assert not standing.fallen


def test_the_lighter_robot_and_the_narrower_limits_stand_too() -> None:
    nao = Nao(mass="thesis", limits="v5", posture="Stand")
    start = nao.torso_pose
    nao.step(150)
    assert _angle_deg(start, nao.torso_pose) < 0.5
    assert nao.fsr.sum() == pytest.approx(4.3 * 9.81, rel=0.02)


@pytest.mark.parametrize("base", ["fixed", "free"])
def test_low_discrepancy_commands_raise_no_warning(base: str, hung: Nao) -> None:
    """Ten seconds of commands that fill the ranges, hung up and falling: nothing unstable, limits kept."""
    nao = hung if base == "fixed" else Nao()
    nao.reset("StandInit")
    points = qmc.Halton(25, seed=3).random(40)
    for point in points:
        nao.set_targets(LOW + point * (HIGH - LOW))
        nao.step(12 + 1)
        assert (nao.setpoint >= LOW).all()
        assert (nao.setpoint <= HIGH).all()
        assert np.maximum(LOW - nao.angles, nao.angles - HIGH).max() < 5e-3
    assert nao.time > 10
    assert not nao.data.warning.number.any()


def test_halving_the_time_step_changes_no_angle_by_half_a_degree() -> None:
    def run(timestep: float) -> np.ndarray:
        spec = model_spec()
        spec.option.timestep = timestep
        nao = Nao(model=spec.compile())
        angles = []
        for k in range(200):
            phase = 2 * np.pi * k / 50
            nao.set_angles("RArm", [-0.6 + 0.5 * np.sin(phase), -0.5, 1.2, 1.0 + 0.4 * np.cos(phase), 0.3, 0.5])
            nao.set_angles("Head", [0.4 * np.sin(phase), 0.1])
            nao.step()
            angles.append(nao.angles[[i for i, n in enumerate(ACTUATED) if not n.endswith("Hand")]])
        return np.degrees(np.array(angles))

    assert np.abs(run(0.005) - run(0.0025)).max() < 0.5


def test_same_commands_same_trajectory_bit_for_bit() -> None:
    def run() -> list[bytes]:
        nao = Nao()
        rng = np.random.default_rng(11)
        states = []
        for _ in range(10):
            nao.set_targets(np.clip(nao.targets + rng.normal(0, 0.2, 25), LOW, HIGH))
            nao.step(10)
            states.append(nao.data.qpos.tobytes() + nao.data.qvel.tobytes())
        return states

    assert run() == run()


def test_a_reset_forgets_everything(standing: Nao) -> None:
    standing.reset("StandInit")
    standing.step(20)
    first = standing.data.qpos.copy()
    standing.set_angles("Body", 0.0)
    standing.step(20)
    standing.reset("StandInit")
    assert standing.time == 0
    standing.step(20)
    assert (standing.data.qpos == first).all()


@pytest.mark.parametrize("direction", [(1, 0), (-1, 0), (0, 1)])
def test_a_fall_is_known_within_100_ms(direction: tuple[int, int], standing: Nao) -> None:
    """Pushed over: from the first touch of anything but the feet, it takes one control period to say so."""
    standing.reset("StandZero")
    standing.step(10)
    assert not standing.fallen
    torso = standing.model.body("torso").id
    feet = {standing.model.body(f"{side}_foot").id for side in "lr"}
    touched_at = known_at = None
    for _ in range(250):
        standing.data.xfrc_applied[torso, :2] = np.array(direction) * (25 if standing.time < 0.7 else 0)
        standing.step()
        bodies = standing.model.geom_bodyid[standing.data.contact.geom]
        touched = any(a == 0 and b not in feet for a, b in bodies.tolist())
        if touched and touched_at is None:
            touched_at = standing.time
        if standing.fallen and known_at is None:
            known_at = standing.time
        if touched_at is not None and standing.time > touched_at + 0.2:
            break
    standing.data.xfrc_applied[:] = 0
    assert touched_at is not None
    assert known_at is not None
    assert known_at <= touched_at + 0.1


def test_an_unstable_simulation_says_so(standing: Nao) -> None:
    standing.reset("StandInit")
    standing.data.qvel[:] = 1e12
    with pytest.raises(UnstableError, match="unstable at"):
        standing.step(2)
    standing.reset("StandInit")
    standing.step(2)
    assert not standing.data.warning.number.any()


def test_model_alone_stands_without_our_python(model: mujoco.MjModel) -> None:
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.key("StandInit").id)
    start = data.qpos[:7].copy()
    mujoco.mj_step(model, data, 2500)
    assert np.abs(data.qpos[:2] - start[:2]).max() < 1e-3
    assert _angle_deg(start, data.qpos[:7]) < 0.5
