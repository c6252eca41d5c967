"""What every test may use."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from nao_sim.rendering import gl_problem

CHECKOUT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def sample_clips() -> Path:
    """The folder of sample clips."""
    return CHECKOUT / "assets" / "clips"


@pytest.fixture(scope="session")
def recorded() -> Callable[[str], Path]:
    """Find a file or folder of the public recordings, or skip where it is not at hand."""

    def find(name: str) -> Path:
        folder = os.environ.get("NAO_SIM_RECORDINGS")
        if not folder:
            pytest.skip("needs public recordings in the folder NAO_SIM_RECORDINGS: see docs/recordings.md")
        if not (Path(folder) / name).exists():
            pytest.skip(f"NAO_SIM_RECORDINGS has no {name}: see docs/recordings.md")
        return Path(folder) / name

    return find


@pytest.fixture(scope="session")
def gl() -> None:
    """Skip where nothing can be rendered."""
    problem = gl_problem()
    if problem is not None:
        pytest.skip(problem)
