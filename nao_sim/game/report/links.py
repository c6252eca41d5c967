"""Links from the report to the films that stay where they are."""

from __future__ import annotations

import os
from pathlib import Path
from urllib.parse import quote


def film_link(report: Path, folder: Path, film: str | None, at_s: float | None) -> str | None:
    """Return the address of a moment of a film, relative to the report; None where no film shows it.

    Args:
        report: the folder of the report.
        folder: the session's folder.
        film: the film, relative to that folder.
        at_s: the moment, in seconds.
    """
    if not film:
        return None
    relative = Path(os.path.relpath(folder / film, report)).as_posix()
    moment = "" if at_s is None else f"#t={max(0.0, at_s):.1f}"
    return quote(relative if relative.startswith(".") else f"./{relative}", safe="/.") + moment
