"""The shipped recogniser, which takes seconds to learn its database, once for all."""

from __future__ import annotations

import pytest

from nao_sim.resources import resource
from recognizer import Recognizer


@pytest.fixture(scope="session")
def shipped() -> Recognizer:
    return Recognizer.load(resource("assets", "databases", "dynamic.parquet"))
