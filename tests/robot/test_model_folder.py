"""The model folder's contract: what MuJoCo Menagerie asks of one, and more."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET

import mujoco
import pytest

from nao_sim.resources import resource
from nao_sim.robot import BODY, postures

FOLDER = resource("models", "nao")
README = (FOLDER / "README.md").read_text("utf-8")


@pytest.mark.parametrize("name", ["nao.xml", "scene.xml", "README.md", "CHANGELOG.md", "LICENSE", "nao.png"])
def test_the_folder_has(name: str) -> None:
    assert (FOLDER / name).stat().st_size > 100


def test_changelog_is_this_models() -> None:
    assert (FOLDER / "CHANGELOG.md").read_text("utf-8").startswith("# Changelog of the NAO model")


def test_pictures_are_small_and_shown() -> None:
    shown = re.findall(r"\]\((\w+\.png)\)", README)
    assert len(shown) >= 3
    for name in shown:
        assert (FOLDER / name).stat().st_size < 150_000


def test_the_derivation_is_numbered_and_says_what_is_guessed() -> None:
    steps = [int(n) for n in re.findall(r"^(\d+)\. \*\*", README, flags=re.MULTILINE)]
    assert steps == list(range(1, len(steps) + 1))
    assert len(steps) >= 10
    assert "**guessed**" in README
    assert "**tuned**" in README.lower()


def test_all_conflicts_are_decided() -> None:
    assert re.findall(r"^\| C(\d+) \|", README, flags=re.MULTILINE) == [str(n) for n in range(1, 19)]


def test_no_files_but_the_robots_own_are_needed() -> None:
    root = ET.parse(FOLDER / "nao.xml").getroot()
    assert not [e for e in root.iter() if "file" in e.attrib]
    assert {e.get("builtin") for e in root.iter("mesh")} == {"supersphere"}


def test_robot_alone_and_scene_compile() -> None:
    robot = mujoco.MjModel.from_xml_path(str(FOLDER / "nao.xml"))
    scene = mujoco.MjModel.from_xml_path(str(FOLDER / "scene.xml"))
    assert scene.ngeom == robot.ngeom + 1
    assert {robot.joint(k).name for k in range(robot.njnt)} >= {*BODY, "root"}


def test_official_postures_are_keyframes() -> None:
    scene = mujoco.MjModel.from_xml_path(str(FOLDER / "scene.xml"))
    assert [scene.key(k).name for k in range(scene.nkey)] == list(postures())


def test_dm_control_loads_the_scene() -> None:
    from dm_control import mujoco as dm_mujoco

    physics = dm_mujoco.Physics.from_xml_path(str(FOLDER / "scene.xml"))
    with physics.reset_context():
        physics.named.data.qpos["HeadYaw"] = 0.25
    physics.step(10)
    assert physics.named.data.qpos["HeadYaw"][0] == pytest.approx(0.0, abs=0.2)
