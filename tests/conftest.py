"""What every test may use."""

from __future__ import annotations

from pathlib import Path

import pytest

from nao_sim.rendering import gl_problem

CHECKOUT = Path(__file__).resolve().parents[1]


@pytest.fixture(scope="session")
def sample_clips() -> Path:
    """The folder of sample clips."""
    return CHECKOUT / "assets" / "clips"


@pytest.fixture(scope="session")
def real_clips() -> Path:
    """Recordings of real people, kept beside the checkout and not part of it."""
    folder = CHECKOUT.parent / "shared" / "clips"
    if not folder.is_dir():
        pytest.skip("real recordings are not beside this checkout")
    return folder


@pytest.fixture(scope="session")
def gl() -> None:
    """Skip where nothing can be rendered."""
    problem = gl_problem()
    if problem is not None:
        pytest.skip(problem)
