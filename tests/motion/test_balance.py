import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from nao_sim.motion.balance import Balance, Gains, lean_of, planned_lean
from nao_sim.motion.whole_body import standing_torso
from nao_sim.robot import ACTUATED, Nao, posture

HOME = np.array([posture("StandInit")[name] for name in ACTUATED])


def column(name):
    return ACTUATED.index(name)


@pytest.mark.parametrize("heading_deg", [0.0, 70.0, -160.0])
def test_lean_does_not_depend_on_the_heading(heading_deg):
    turned = Rotation.from_euler("ZYX", [heading_deg, 20.0, -5.0], degrees=True)
    lean = lean_of(turned.as_quat(scalar_first=True)[None])
    assert np.rad2deg(lean[0]) == pytest.approx([-5.0, 20.0], abs=0.01)


def test_planned_lean_of_stand_init_is_its_pitch():
    assert planned_lean(HOME[None])[0] == pytest.approx([0.0, standing_torso()[0]], abs=1e-6)


def test_planned_lean_agrees_with_the_standing_robot():
    nao = Nao()
    nao.step(50)
    assert planned_lean(nao.angles[None])[0] == pytest.approx(lean_of(nao.torso_pose[None, 3:])[0], abs=np.deg2rad(0.3))


def test_no_lean_needs_no_correction():
    assert not Balance(3).correct(np.zeros((3, 2)), np.zeros((3, 2)), np.zeros(2)).any()


def test_leaning_forward_pushes_the_toes_down_and_the_hips_back():
    offsets = Balance().correct(np.array([[0.0, 0.1]]), np.zeros((1, 2)), np.zeros(2))[0]
    for name in ("LAnklePitch", "RAnklePitch", "LHipPitch", "RHipPitch"):
        assert offsets[column(name)] > 0
    assert offsets[column("LAnkleRoll")] == offsets[column("HeadYaw")] == 0


def test_each_row_is_a_robot_of_its_own():
    rng = np.random.default_rng(3)
    crowd, ones = Balance(4), [Balance() for _ in range(4)]
    for _ in range(20):
        lean, rate, planned = rng.normal(0, 0.05, (4, 2)), rng.normal(0, 0.3, (4, 2)), rng.normal(0, 0.1, 2)
        together = crowd.correct(lean, rate, planned)
        alone = [one.correct(lean[[k]], rate[[k]], planned)[0] for k, one in enumerate(ones)]
        assert np.allclose(together, alone)


def test_offsets_are_bounded():
    offsets = Balance().correct(np.full((1, 2), 3.0), np.full((1, 2), 50.0), np.zeros(2))
    assert np.abs(offsets).max() == pytest.approx(Gains().most_rad)
