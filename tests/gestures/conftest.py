from pathlib import Path

import pytest

GOOD = """
name = "hello"
kind = "cyclic"
cycle = { first = "out", last = "out_again", repetitions = 2 }

[[key_frame]]
time = 0.5
angles = { RShoulderPitch = 20, RElbowRoll = 40, RHand = 1 }
mark = "out"

[[key_frame]]
time = 0.9
angles = { RElbowRoll = 60 }

[[key_frame]]
time = 1.3
angles = { RShoulderPitch = 20, RElbowRoll = 40, RHand = 1 }
mark = "out_again"

[[key_frame]]
time = 2.0
rest = true
"""


@pytest.fixture
def good() -> str:
    return GOOD


@pytest.fixture
def write(tmp_path: Path):
    def _write(text: str | bytes, name: str = "hello.toml") -> Path:
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return _write
