"""``nao-sim check``: is this installation sound?"""

from __future__ import annotations

import json
import platform
from collections.abc import Callable
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated

import typer

_PACKAGES = ("nao-sim", "mujoco", "dm-control", "mink", "numpy", "scipy", "scikit-learn", "pyarrow", "rerun-sdk")
_OPENCV = ("opencv-python-headless", "opencv-python", "opencv-contrib-python")


@dataclass(frozen=True)
class Finding:
    """One thing looked at: what, whether it holds (None: it is only told), and the detail."""

    what: str
    ok: bool | None
    detail: str


def _versions() -> list[Finding]:
    findings = [Finding("python", None, platform.python_version())]
    findings += [Finding(name, None, version(name)) for name in _PACKAGES]
    for name in _OPENCV:
        try:
            findings.append(Finding("opencv", None, f"{version(name)} ({name})"))
        except PackageNotFoundError:
            continue
    return findings


def _mujoco_and_dm_control() -> str:
    from dm_control import mujoco as dm_mujoco

    from nao_sim.resources import resource

    physics = dm_mujoco.Physics.from_xml_path(str(resource("models", "nao", "scene.xml")))
    physics.step()
    return f"a NAO of {physics.model.nu} motors steps in dm_control.mujoco.Physics"


def _models_and_assets() -> str:
    from nao_sim.gestures import library, vocabulary
    from nao_sim.resources import resource

    count, classes = len(library()), len(vocabulary())
    resource("assets", "databases", "dynamic.parquet")
    return f"{count} gestures for {classes} classes; models in {resource('models')}, assets in {resource('assets')}"


def _rendering() -> str:
    from nao_sim.rendering import gl_problem_elsewhere

    problem = gl_problem_elsewhere()
    if problem is not None:
        raise RuntimeError(problem)
    import os

    return f"a picture was rendered with MUJOCO_GL={os.environ.get('MUJOCO_GL', '(not set)')}"


def _try(what: str, look: Callable[[], str]) -> Finding:
    try:
        return Finding(what, True, look())
    except Exception as error:  # whatever is broken, the table says so
        return Finding(what, False, " ".join(f"{error}".split()) or type(error).__name__)


def check(as_json: Annotated[bool, typer.Option("--json", help="Print the findings as JSON.")] = False) -> None:
    """Print versions, and whether physics, rendering, models and assets are sound.

    Exit code 1 if the main job cannot run. Without OpenGL it can: only cameras and rendered people need it.
    """
    findings = _versions()
    required = [
        _try("mujoco + dm_control", _mujoco_and_dm_control),
        _try("models and assets", _models_and_assets),
    ]
    findings += [*required, _try("rendering (optional)", _rendering)]
    if as_json:
        typer.echo(json.dumps([asdict(finding) for finding in findings], indent=2))
    else:
        _print(findings)
    if not all(finding.ok for finding in required):
        raise typer.Exit(1)


def _print(findings: list[Finding]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    sign = {None: "", True: "[green]ok[/]", False: "[red]not ok[/]"}
    table = Table(show_header=False, box=None)
    for finding in findings:
        table.add_row(finding.what, sign[finding.ok], escape(finding.detail))
    Console(emoji=False).print(table)
