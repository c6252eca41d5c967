"""Installed as a wheel into an empty environment, in another directory, everything still finds its files."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parents[2]

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("dist")
    command = [sys.executable, "-m", "build", "--wheel", "--no-isolation", "--outdir", str(out), str(CHECKOUT)]
    subprocess.run(command, check=True, capture_output=True, text=True)
    return next(out.glob("*.whl"))


@pytest.fixture(scope="module")
def environment(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """An environment that holds the wheel, and its dependencies by path.

    The path entry lends the third-party packages only: a .pth file inside the lent folder, and so the editable
    install of the checkout, is not read from there.
    """
    root = tmp_path_factory.mktemp("env")
    venv.create(root, with_pip=False, symlinks=True)
    site = Path(sysconfig.get_path("purelib", vars={"base": str(root)}))
    site.joinpath("lent.pth").write_text(sysconfig.get_path("purelib") + "\n")
    pip = [sys.executable, "-m", "pip", "--python", str(root / "bin" / "python")]
    install = [*pip, "install", "--quiet", "--no-deps", "--no-index", "--force-reinstall", str(wheel)]
    subprocess.run(install, check=True, capture_output=True, text=True)
    return root


def run(environment: Path, cwd: Path, *arguments: str) -> subprocess.CompletedProcess[str]:
    env = {k: v for k, v in os.environ.items() if k != "PYTHONPATH"}
    command = [str(environment / "bin" / "nao-sim"), *arguments]
    return subprocess.run(command, cwd=cwd, env=env, capture_output=True, text=True, check=False)


def test_wheel_carries_models_and_assets(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert "nao_sim/models/nao/nao.xml" in names
    assert "nao_sim/assets/vocabulary.toml" in names
    assert not [name for name in names if name.startswith(("tests/", "models/", "assets/"))]


def test_everything_is_found_from_another_directory(environment: Path, tmp_path: Path) -> None:
    python = [str(environment / "bin" / "python"), "-c", "import nao_sim; print(nao_sim.__file__)"]
    found = subprocess.run(python, cwd=tmp_path, capture_output=True, text=True, check=True).stdout
    assert str(environment) in found
    checked = run(environment, tmp_path, "check", "--json")
    assert checked.returncode == 0, checked.stdout + checked.stderr


def test_main_job_runs_from_the_wheel(environment: Path, tmp_path: Path) -> None:
    clip = CHECKOUT / "assets" / "clips" / "bye_right.avi"
    done = run(environment, tmp_path, "imitate", str(clip), "--out", "episode", "--json")
    assert done.returncode == 0, done.stderr
    assert json.loads(done.stdout)["seen"]["label"] == "bye_right"
    assert {p.name for p in (tmp_path / "episode").iterdir()} == {"episode.json", "episode.parquet", "episode.rrd"}
