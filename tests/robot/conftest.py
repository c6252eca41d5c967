"""Models compiled once for all tests of the robot."""

from __future__ import annotations

import mujoco
import pytest

from nao_sim.robot import Nao, model_spec


@pytest.fixture(scope="session")
def model() -> mujoco.MjModel:
    """The robot on its floor."""
    return model_spec().compile()


@pytest.fixture(scope="session")
def standing() -> Nao:
    """One robot for tests that begin with a reset."""
    return Nao()


@pytest.fixture(scope="session")
def hung() -> Nao:
    """One robot with its torso fixed in the air, for tests that begin with a reset."""
    return Nao(base="fixed")
