"""Commands with motion files: the range set asked for, folders, exit codes, JUnit, conversion."""

import json
import re
import subprocess
import sys
from pathlib import Path
from xml.etree import ElementTree

import pytest

LEGS = ",".join(f"{side}{joint}Pitch" for side in "LR" for joint in ("Hip", "Knee", "Ankle"))
POSE = "0,-0.0908,0.0908,0,-0.0908,0.0908"
KNEES = f"#WEBOTS_MOTION,V1.0,{LEGS}\n00:02:000,a,{POSE}\n00:03:000,b,{POSE}\n"
COMMANDS = ["play", "export", "stress --trials 2 --no-sweep --at-least 0", "validate"]
CHECKOUT = Path(__file__).resolve().parents[2]


@pytest.fixture
def knees(tmp_path):
    path = tmp_path / "knees[v5].motion"
    path.write_text(KNEES)
    return path


@pytest.mark.parametrize("command", COMMANDS, ids=lambda words: words.split()[0])
def test_the_range_set_that_was_asked_for_decides(nao_sim, knees, tmp_path, command):
    words = [*command.split(), knees, *([tmp_path / "out.csv"] if command == "export" else [])]
    assert nao_sim(*words, "--limits", "v5").code == 0
    ran = nao_sim(*words)
    assert ran.code == (1 if command == "validate" else 2)
    said = " ".join((ran.out + ran.err).split())
    for part in ("LKneePitch", "-5.20", "'thesis' range -5.00 .. 125.00 deg", "'v5' allows it"):
        assert part in said


@pytest.mark.parametrize(
    ("words", "code", "said"),
    [
        ("validate missing.motion", 2, "no such motion file"),
        ("validate yes --limits v6", 2, "known: thesis, v5, envelope"),
        ("validate yess", 2, "did you mean 'yes'?"),
        ("validate --model yes", 2, "--model takes no gestures"),
        ("validate yes --units furlongs", 2, "is no unit"),
        ("validate yes --longest nan", 2, "positive number of seconds"),
        ("stress yes --at-least nan", 2, "no share"),
        ("stress yes --at-least 1.5", 2, "no share"),
        ("stress yes --video a.mp4", 2, "--replay"),
        ("stress yes --replay 1 --at-least 0.5", 2, "--replay plays one"),
        ("convert walk_left_to_right a.csv", 2, "is a walk"),
        ("convert yes a.rrd", 2, "is read, not written"),
        ("validate empty", 2, "holds no motion file"),
    ],
)
def test_errors_are_two_and_one_line_that_helps(nao_sim, tmp_path, monkeypatch, words, code, said):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    ran = nao_sim(*words.split())
    assert ran.code == code
    assert said in " ".join(re.sub("[│╭╮╰╯─]", " ", ran.err).split())
    assert ran.err.count("missing.motion") <= 1


def test_folders_have_a_table_a_summary_and_junit(nao_sim, knees, tmp_path):
    (tmp_path / "deeper").mkdir()
    (tmp_path / "deeper" / "look.csv").write_text("time_s,HeadYaw_rad\n0.5,0.2\n1.0,0.0\n")
    (tmp_path / "ms.csv").write_text("time,HeadYaw_rad\n" + "".join(f"{40 * n},0.1\n" for n in range(40)))
    (tmp_path / "notes.csv").write_text("who,what\nanna,waved\n")
    (tmp_path / "test_x.py").write_text("def test_x(): pass\n")
    ran = nao_sim("validate", tmp_path, "--junit", tmp_path / "out.xml")
    assert ran.code == 2
    assert "1 pass, 1 do not, 1 cannot be read; limits: thesis" in ran.out
    assert "2 other files are no motions: notes.csv, test_x.py" in ran.out
    assert "lasts 26 minutes" in ran.out
    assert "knees[v5].motion" in "".join(ran.out.split())
    suite = ElementTree.parse(tmp_path / "out.xml").getroot()
    assert [suite.get(key) for key in ("tests", "failures", "errors")] == ["3", "1", "1"]
    (failure,) = suite.iter("failure")
    assert failure.text.splitlines()[0].startswith("LKneePitch at 2.00 s (2.00 to 3.00 s) is -5.20")
    assert len(failure.text.splitlines()) == 2
    (tmp_path / "ms.csv").unlink()
    rows = json.loads(nao_sim("validate", tmp_path, "--json", "--limits", "v5").out)
    assert [row["faults"] for row in rows] == [[], []]
    assert {row["limits"] for row in rows} == {"v5"}


def test_convert_goes_through_every_format_and_back(nao_sim, tmp_path):
    first = tmp_path / "a.csv"
    first.write_text("time_s,HeadYaw_deg,RHand\n0.480,11.50000,0.50000\n1.000,-20.00000,0.50000\n")
    path = first
    for suffix in (".motion", ".py", ".xar", ".toml", ".parquet", ".csv"):
        following = tmp_path / f"b{suffix}"
        ran = nao_sim("convert", path, following)
        assert ran.code == 0, ran.err
        path = following
    header, *rows = [line.split(",") for line in path.read_text().splitlines()]
    assert header == ["time_s", "HeadYaw_deg", "RHand"]
    kept = {float(row[0]): float(row[1]) for row in rows}
    assert kept[0.48] == pytest.approx(11.5, abs=1e-3)
    assert kept[1.0] == pytest.approx(-20.0, abs=1e-3)
    said = nao_sim("convert", first, tmp_path / "b.pos").err
    assert "23 joints that the motion does not name are written as in StandInit" in said


def example(folder: Path) -> None:
    """Make the repository that docs/validation.md shows."""
    text = (CHECKOUT / "docs" / "validation.md").read_text(encoding="utf-8")
    for name, content in re.findall(r"\*\*`([^`]+)`\*\*\n\n```\w*\n(.*?)```", text, re.S):
        (folder / name).parent.mkdir(exist_ok=True)
        (folder / name).write_text(content)


def pytest_in(folder: Path, *words: str) -> subprocess.CompletedProcess[str]:
    command = [sys.executable, "-m", "pytest", "-p", "no:cacheprovider", "-p", "no:xdist", *words]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, check=False)


def test_the_documented_repository_is_tested_by_the_plugin(tmp_path):
    example(tmp_path)
    ran = pytest_in(tmp_path, "-q")
    assert ran.returncode == 0, ran.stdout
    assert "4 passed" in ran.stdout
    (tmp_path / "motions" / "step.csv").write_text("time_s,HeadYaw_rad,LElbowRoll_rad\n1,0,-0.01\n1.02,1,-0.1\n")
    (tmp_path / "motions" / "bare.csv").write_text("time_s,HeadYaw\n1,0.5\n")
    ran = pytest_in(tmp_path, "motions", "--nao-limits", "v5,thesis", "-q", "--junit-xml", "out.xml")
    assert ran.returncode == 1
    assert "4 failed, 4 passed" in ran.stdout
    failures = {
        f"{case.get('classname')}::{case.get('name')}": failure.text
        for case in ElementTree.parse(tmp_path / "out.xml").getroot().iter("testcase")
        for failure in case.iter("failure")
    }
    lines = failures["motions.step.csv::v5"].splitlines()
    assert lines[0].startswith("LElbowRoll at 1.00 s is -0.57, 1.4 beyond its 'v5' range -88.50 .. -2.00 deg; 'thesis'")
    assert lines[1].startswith("HeadYaw at 1.00 s steps by 57.3 deg: asked for 2864.8 deg/s")
    assert "'v5'" not in failures["motions.step.csv::thesis"]
    assert "no unit" in failures["motions.bare.csv::thesis"]
    ran = pytest_in(tmp_path, "motions", "--nao-limits", "v6")
    assert ran.returncode == 4
    assert "no range set 'v6'" in ran.stderr


def test_the_plugin_is_silent_and_free_where_it_is_not_used(tmp_path):
    (tmp_path / "wave.motion").write_text(KNEES)
    (tmp_path / "test_none.py").write_text(
        "import os, sys\n\ndef test_none():\n    assert 'MUJOCO_GL' not in os.environ\n"
        "    assert not {'nao_sim', 'mujoco', 'numpy'} & set(sys.modules)\n"
    )
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-p", "no:hypothesispytest"]
    environment = {"PATH": "/usr/bin:/bin"}
    ran = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True, check=False, env=environment)
    assert "1 passed" in ran.stdout, ran.stdout
