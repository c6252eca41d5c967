"""The examples run as the README shows them, and say what they should."""

from __future__ import annotations

import runpy
import sys
from pathlib import Path

import pytest

CHECKOUT = Path(__file__).resolve().parents[2]
SAID = {
    "robot": ["stayed upright"],
    "stream": ["bye_right, distance"],
    "own_gesture": ["nothing wrong with it", "ends standing"],
}


@pytest.mark.parametrize("name", SAID)
def test_example_says_what_it_should(
    name: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(sys, "argv", [f"{name}.py"])
    runpy.run_path(str(CHECKOUT / "examples" / f"{name}.py"), run_name="__main__")
    said = capsys.readouterr().out
    assert all(words in said for words in SAID[name])


def test_every_example_runs_and_is_linked_from_the_readme() -> None:
    readme = (CHECKOUT / "README.md").read_text(encoding="utf-8")
    assert {path.stem for path in CHECKOUT.glob("examples/*.py")} == set(SAID)
    assert all(f"(examples/{name}.py)" in readme for name in SAID)
