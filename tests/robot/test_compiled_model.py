"""The compiled model against the data files, joint by joint and link by link."""

from __future__ import annotations

import itertools
import tomllib

import mujoco
import numpy as np
import pytest

from nao_sim.resources import resource
from nao_sim.robot import ACTUATED, BODY, UnknownNameError, joint_table, model_spec
from nao_sim.robot.placement import set_joints

LINKS = tomllib.loads(resource("assets", "nao", "links.toml").read_text("utf-8"))
SENSORS = tomllib.loads(resource("assets", "nao", "sensors.toml").read_text("utf-8"))
CONTROLLERS = tomllib.loads(resource("assets", "nao", "motors.toml").read_text("utf-8"))["controller"]
XML = mujoco.MjModel.from_xml_path(str(resource("models", "nao", "scene.xml")))


@pytest.mark.parametrize("name", BODY)
def test_joint(name: str) -> None:
    row, joint = joint_table()[name], XML.joint(name)
    assert joint.range == pytest.approx(row.thesis, abs=1e-6)
    assert joint.limited[0]
    assert joint.axis == pytest.approx(row.axis, abs=1e-6)
    assert joint.pos == pytest.approx([0, 0, 0])
    child, parent = XML.body(row.child), XML.body(row.parent)
    assert XML.jnt_bodyid[joint.id] == child.id
    assert XML.body_parentid[child.id] == parent.id
    assert child.pos == pytest.approx(row.pos_m, abs=1e-6)
    assert XML.dof_armature[joint.dofadr[0]] == pytest.approx(row.motor.rotor_inertia_kgm2 * row.reduction**2, rel=1e-5)
    assert XML.jnt_solref[joint.id, 0] == pytest.approx(2 * XML.opt.timestep)


def test_actuators_are_the_motors_in_order() -> None:
    assert [XML.actuator(k).name for k in range(XML.nu)] == list(ACTUATED)


@pytest.mark.parametrize("name", ACTUATED)
def test_motor(name: str) -> None:
    row, actuator = joint_table()[name], XML.actuator(name)
    assert XML.jnt_bodyid[actuator.trnid[0]] == XML.body(row.child).id
    assert actuator.ctrlrange == pytest.approx(row.thesis, abs=1e-6)
    assert actuator.forcerange == pytest.approx([-row.effort_nm, row.effort_nm])
    gains = CONTROLLERS[str(row.reduction)]
    assert actuator.gainprm[4] == pytest.approx(gains["kp_nm_rad"])
    assert actuator.gainprm[6] == pytest.approx(gains["kd_nms_rad"])


@pytest.mark.parametrize("name", [k for k, v in LINKS.items() if isinstance(v, dict)])
def test_link_and_its_mirror_image(name: str, model: mujoco.MjModel) -> None:
    data = mujoco.MjData(model)
    set_joints(model, data, np.zeros(26))
    mujoco.mj_kinematics(model, data)
    for side in (1, -1) if name.startswith("l_") else (1,):
        link = LINKS[name]
        body = ("l_" if side > 0 else "r_") + name[2:] if name.startswith("l_") else name
        mass, com, inertia = _with_fingers(model, data, body)
        flip = np.diag([1, side, 1])
        ixx, iyy, izz, ixy, ixz, iyz = link["inertia_kgm2"]
        tensor = np.array([[ixx, ixy, ixz], [ixy, iyy, iyz], [ixz, iyz, izz]])
        assert mass == pytest.approx(link["mass_kg"], rel=1e-6)
        assert com == pytest.approx(flip @ link["com_m"], abs=2e-7)
        assert inertia == pytest.approx(flip @ tensor @ flip, abs=3e-10)


def _with_fingers(model: mujoco.MjModel, data: mujoco.MjData, name: str) -> tuple[float, np.ndarray, np.ndarray]:
    """Mass, centre and central inertia of a link in its frame; a hand with its fingers closed."""
    ids = [model.body(name).id]
    if name.endswith("_hand"):
        ids += [model.body(name[:2] + part).id for part in ("fingers", "fingertips", "thumb")]
    frame, origin = data.xmat[ids[0]].reshape(3, 3), data.xpos[ids[0]]
    masses = model.body_mass[ids]
    centres = (data.xipos[ids] - origin) @ frame
    com = masses @ centres / masses.sum()
    total = np.zeros((3, 3))
    for body, mass, centre in zip(ids, masses, centres - com, strict=True):
        axes = frame.T @ data.ximat[body].reshape(3, 3)
        total += axes @ np.diag(model.body_inertia[body]) @ axes.T
        total += mass * (centre @ centre * np.eye(3) - np.outer(centre, centre))
    return float(masses.sum()), com, total


def test_masses_of_the_variants() -> None:
    assert XML.body_mass.sum() == pytest.approx(5.30535, rel=1e-6)
    light = model_spec(mass="thesis").compile()
    assert light.body_mass.sum() == pytest.approx(4.3, rel=1e-6)
    assert light.body_inertia == pytest.approx(XML.body_inertia * 4.3 / 5.30535, rel=1e-6)


def test_variants_compile_and_step() -> None:
    for limits, base, fingers in itertools.product(("thesis", "v5", "envelope"), ("free", "fixed"), (True, False)):
        variant = model_spec(limits, base=base, fingers=fingers).compile()
        assert variant.nv == (6 if base == "free" else 0) + 26 + (4 if fingers else 0)
        ranges = np.array([variant.joint(name).range for name in BODY])
        assert ranges == pytest.approx(joint_table().range_rad(limits), abs=1e-12)
        data = mujoco.MjData(variant)
        mujoco.mj_step(variant, data, 20)
        assert not data.warning.number.any()


@pytest.mark.parametrize("bad", [{"limits": "v7"}, {"mass": "heavy"}, {"base": "flying"}])
def test_unknown_variant(bad: dict[str, str]) -> None:
    with pytest.raises(UnknownNameError):
        model_spec(**bad)


def test_one_box_a_sole_on_the_floor() -> None:
    for side in "lr":
        boxes = [
            g
            for g in range(XML.ngeom)
            if XML.geom_bodyid[g] == XML.body(f"{side}_foot").id
            and XML.geom_type[g] == mujoco.mjtGeom.mjGEOM_BOX
            and XML.geom_contype[g]
        ]
        assert len(boxes) == 1
        bottom = XML.geom_pos[boxes[0], 2] - XML.geom_size[boxes[0], 2]
        assert bottom == pytest.approx(-SENSORS["foot"]["sole_height_m"], abs=1e-9)
        assert XML.site(f"{side}_sole").pos[2] == pytest.approx(bottom)


def test_camera_places_and_angles() -> None:
    camera = SENSORS["camera"]
    for name, position, pitch in zip(camera["names"], camera["position_m"], camera["pitch_down_deg"], strict=True):
        found = XML.camera(name)
        assert XML.cam_bodyid[found.id] == XML.body("head").id
        assert found.pos == pytest.approx(position, abs=1e-6)
        assert found.fovy[0] == pytest.approx(camera["vertical_fov_deg"])
        rotation = np.zeros(9)
        mujoco.mju_quat2Mat(rotation, found.quat)
        looks = -rotation.reshape(3, 3)[:, 2]
        assert np.degrees(np.arcsin(-looks[2])) == pytest.approx(pitch, abs=1e-4)
        assert looks[1] == pytest.approx(0, abs=1e-9)
        assert tuple(XML.cam_resolution[found.id]) == (camera["width_px"], camera["height_px"])


def test_sensor_places() -> None:
    foot = SENSORS["foot"]
    for corner, (x, y) in foot["fsr_m"].items():
        assert XML.site(f"LFsr{corner}").pos[:2] == pytest.approx([x, y], abs=1e-6)
        mirror = corner[0] + {"L": "R", "R": "L"}[corner[1]]
        assert XML.site(f"RFsr{mirror}").pos[:2] == pytest.approx([x, -y], abs=1e-6)
    for name in ("Accelerometer", "Gyrometer"):
        assert XML.site(name).pos == pytest.approx(SENSORS["inertial"][f"{name.lower()}_m"], abs=1e-6)
    for name, place in SENSORS["touch"].items():
        for prefix in ("",) if name.startswith("Head") else ("L", "R"):
            assert XML.site(prefix + name).pos == pytest.approx(place, abs=1e-6)
