import mujoco
import numpy as np
import pytest

from nao_sim.gestures import library
from nao_sim.motion import MotionError
from nao_sim.motion.balance import planned_lean
from nao_sim.motion.support import centre_of_mass
from nao_sim.motion.whole_body import TorsoPath, plant_feet, standing_torso
from nao_sim.robot import ACTUATED, Nao, posture

HOME = np.array([posture("StandInit")[name] for name in ACTUATED])


@pytest.fixture(scope="module")
def nao():
    return Nao(fingers=False)


def stance(nao, targets):
    """Place the left sole on the floor and return the right sole's pose and the centre of mass relative to it."""
    model, data = nao.model, mujoco.MjData(nao.model)
    for name, value in zip(ACTUATED, targets, strict=True):
        data.qpos[model.joint(name).qposadr[0]] = value
    data.qpos[model.joint("RHipYawPitch").qposadr[0]] = targets[ACTUATED.index("LHipYawPitch")]
    mujoco.mj_kinematics(model, data)
    left, right = data.site("l_sole"), data.site("r_sole")
    turn = left.xmat.reshape(3, 3).T
    pose = np.concatenate([data.xpos, data.xquat], axis=1)
    com = centre_of_mass(model, pose[None])[0]
    return turn @ (right.xpos - left.xpos), turn @ right.xmat.reshape(3, 3), turn @ (com - left.xpos)


def path(pitch=None, roll=0.0, height=0.0):
    pitch = standing_torso()[0] if pitch is None else pitch
    return TorsoPath(np.array([pitch]), np.array([roll]), np.array([height]))


def test_nothing_asked_is_stand_init():
    legs = plant_feet(np.zeros(1), HOME[None], path())
    assert np.abs(legs[0] - HOME).max() < np.deg2rad(0.2)


@pytest.mark.parametrize(
    ("joint", "angle_deg", "torso"),
    [
        ("RShoulderPitch", 0.0, {}),
        ("LShoulderRoll", 76.0, {}),
        ("HeadPitch", 20.0, {"pitch": np.deg2rad(66), "height": -0.052}),
        ("HeadYaw", 40.0, {"roll": np.deg2rad(3)}),
        ("RElbowRoll", 80.0, {"height": -0.03}),
    ],
)
def test_soles_stay_and_the_centre_of_mass_stays_above_its_point(nao, joint, angle_deg, torso):
    targets = HOME.copy()
    targets[ACTUATED.index(joint)] = np.deg2rad(angle_deg)
    legs = plant_feet(np.zeros(1), targets[None], path(**torso))[0]
    apart, turned, com = stance(nao, legs)
    home_apart, _, home_com = stance(nao, HOME)
    assert np.abs(apart - home_apart).max() < 1e-3
    assert np.abs(turned - np.eye(3)).max() < 5e-3
    assert np.abs(com - home_com)[:2].max() < 2e-3
    lean = planned_lean(legs[None])[0]
    assert lean == pytest.approx([torso.get("roll", 0.0), torso.get("pitch", standing_torso()[0])], abs=5e-3)


def test_what_no_stance_does_is_refused():
    with pytest.raises(MotionError, match=r"no stance with both feet planted at 0\.00 s"):
        plant_feet(np.zeros(1), HOME[None], path(height=0.2))


def test_the_bow_is_planned_to_sixty_degrees_and_more():
    lean = planned_lean(library()["kowtow"].trajectory().targets)
    assert np.rad2deg(lean[:, 1].max()) >= 60.0
    assert np.rad2deg(lean[-1, 1]) == pytest.approx(np.rad2deg(standing_torso()[0]), abs=0.5)
