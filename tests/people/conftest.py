"""One stage for all tests of this folder: opening one takes seconds."""

from collections.abc import Iterator

import pytest

from nao_sim.people.filming.stage import Stage


@pytest.fixture(scope="package")
def stage(gl: None) -> Iterator[Stage]:
    with Stage() as opened:
        yield opened
