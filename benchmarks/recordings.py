"""Where the public recordings lie that some benchmarks need; ``docs/recordings.md`` says which they are."""

from __future__ import annotations

import argparse
import os
from pathlib import Path


def add_option(parser: argparse.ArgumentParser) -> None:
    """Let ``parser`` take the folder of the recordings."""
    parser.add_argument(
        "--recordings",
        type=Path,
        default=os.environ.get("NAO_SIM_RECORDINGS"),
        help="folder of public recordings, see docs/recordings.md; by default NAO_SIM_RECORDINGS",
    )


def recorded(parser: argparse.ArgumentParser, folder: Path | None, *patterns: str) -> list[Path]:
    """Return the files below ``folder`` that match ``patterns``, in order; end the program where there are none."""
    if folder is None:
        parser.error("needs public recordings: give --recordings FOLDER, which docs/recordings.md describes")
    found = [path for pattern in patterns for path in sorted(folder.glob(pattern))]
    if not found:
        parser.error(f"{folder} has no {', '.join(patterns)}; docs/recordings.md says what belongs there")
    return found
