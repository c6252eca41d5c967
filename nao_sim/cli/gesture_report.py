"""The gesture part of ``nao-sim validate``: measures as a table, as JSON and as a picture."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from nao_sim.gestures.validation import Validation


def validate_gestures(
    names: list[str], limits: str, fit: bool, out: Path | None, figure: Path | None, as_json: bool
) -> bool:
    """Try gestures or files (none named: the library), print what was found, and return whether all pass."""
    from nao_sim.cli.progress import stages
    from nao_sim.gestures import GestureError, library
    from nao_sim.gestures.validation import validate_gesture

    if out is not None and not (fit and len(names) == 1):
        raise GestureError("--out needs --fit and exactly one gesture; give both or leave it out")
    names = names or list(library())
    found = []
    with stages(hidden=as_json) as progress:
        for done, name in enumerate(names):
            found.append(validate_gesture(name, limits, fit))
            progress("Validating", done + 1, len(names))
    if out is not None and found[0].trajectory is not None:
        from nao_sim.gestures import save_trajectory

        save_trajectory(found[0].trajectory, out)
    if figure is not None:
        _draw(found, figure)
    rows = [_row(validation) for validation in found]
    if as_json:
        typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
    else:
        _print(rows)
    return not any(validation.faults for validation in found)


def _row(validation: Validation) -> dict[str, Any]:
    from nao_sim.cli.motion_table import as_dict

    measured = {} if validation.measures is None else as_dict(validation.measures)
    changes = [str(change) for change in validation.changes]
    return {"gesture": validation.name, **measured, "changes": changes, "faults": validation.faults}


def _draw(found: list[Validation], figure: Path) -> None:
    from nao_sim.gestures import GestureError
    from nao_sim.gestures.range_picture import draw_range_use

    use = {entry.name: entry.measures.range_use for entry in found if entry.measures is not None}
    try:
        draw_range_use(use, figure)
    except ValueError as error:
        raise GestureError(f"{figure} cannot be drawn: {error}") from None


def _print(rows: list[dict[str, Any]]) -> None:
    from rich.console import Console

    from nao_sim.cli.motion_table import LEGEND, table_of

    console = Console(soft_wrap=True)
    console.print(table_of(rows))
    console.print(LEGEND)
    for row in rows:
        for fault in row["faults"]:
            console.print(f"[red]{row['gesture']}[/]: {fault}")
        for change in row["changes"]:
            console.print(f"{row['gesture']}: changed {change}")
