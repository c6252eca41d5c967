from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import pytest

from nao_sim.cli import main


@dataclass(frozen=True)
class Ran:
    code: int
    out: str
    err: str


@pytest.fixture
def nao_sim(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> Callable[..., Ran]:
    """Run the command line in this process, as a user would type it."""

    def run(*arguments: object) -> Ran:
        monkeypatch.setattr("sys.argv", ["nao-sim", *map(str, arguments)])
        with pytest.raises(SystemExit) as stopped:
            main()
        captured = capsys.readouterr()
        return Ran(int(stopped.value.code or 0), captured.out, captured.err)

    return run
