"""The command line itself: its names, its help, and what it prints of what users call things."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from nao_sim import __version__
from nao_sim.cli.app import COMMANDS
from tests.cli.conftest import Ran

Run = Callable[..., Ran]
NAMES = ["take [/1]", "[red]", "a[b]c", "[link=x]", ":smile:", "ünï [0:3]"]


def test_version_and_help_by_every_name(nao_sim: Run) -> None:
    assert nao_sim("--version").out == f"nao-sim {__version__}\n"
    for asked in ("-h", "--help"):
        said = nao_sim(asked).out
        assert all(command in said for command in COMMANDS)
    done = subprocess.run([sys.executable, "-m", "nao_sim", "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"nao-sim {__version__}\n"


@pytest.mark.parametrize("command", sorted(COMMANDS))
def test_help_texts_are_printed_as_they_stand(command: str, nao_sim: Run) -> None:
    """Square brackets are no markup: no default and no unit is lost."""
    import importlib
    import inspect

    import typer

    function = getattr(importlib.import_module(f"nao_sim.cli.{COMMANDS[command]}"), command.replace("-", "_"))
    said = " ".join(nao_sim(command, "-h").out.split())
    if isinstance(function, typer.Typer):
        return
    for parameter in inspect.signature(function, eval_str=True).parameters.values():
        for note in getattr(parameter.annotation, "__metadata__", ()):
            if getattr(note, "help", None):
                assert " ".join(note.help.split()) in said


@pytest.mark.parametrize("name", NAMES)
def test_names_are_printed_as_they_are(
    name: str, nao_sim: Run, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "200")
    ran = nao_sim("play", "yes", "--out", name)
    assert (ran.code, ran.err) == (0, "")
    assert f"{name}/motion.json" in ran.out
    assert json.loads((tmp_path / name / "motion.json").read_text("utf-8"))["gesture"] == "yes"
    assert name in nao_sim("play", f"{name}/no.csv").err


@pytest.mark.parametrize(("encoding", "read"), [("ascii", "utf-8"), ("cp1252", "cp1252")])
def test_any_terminal_can_be_told_everything(encoding: str, read: str, tmp_path: Path) -> None:
    """Where a letter has no code, it comes as JSON writes it; typer takes ASCII for a mistake and writes UTF-8."""
    environment = {**os.environ, "PYTHONIOENCODING": encoding}
    command = [sys.executable, "-m", "nao_sim"]
    lost = subprocess.run([*command, "play", "Grüße ★.csv"], capture_output=True, env=environment, check=False)
    assert lost.returncode == 2
    assert lost.stderr.count(b"\n") == 1
    table = tmp_path / "Grüße ★.csv"
    table.write_text("time_s,HeadYaw_rad\n0.5,0.1\n")
    told = subprocess.run([*command, "play", str(table), "--json"], capture_output=True, env=environment, check=True)
    assert json.loads(told.stdout.decode(read))["gesture"] == "Grüße ★"
    shown = subprocess.run([*command, "gestures"], capture_output=True, env=environment, check=False)
    assert shown.returncode == 0, shown.stderr
