"""The gesture part of ``nao-sim validate``: measures as a table, as JSON, as JUnit and as a picture."""

from __future__ import annotations

import json
import time
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from nao_sim.gestures.formats import Said
    from nao_sim.gestures.validation import Validation

_INVALID, _ERROR = 1, 2


@dataclass(frozen=True)
class Result:
    """One gesture or file: its validation, or why there is none."""

    name: str
    validation: Validation | None
    error: str | None
    seconds: float


def validate_gestures(
    names: list[str],
    limits: str,
    fit: bool,
    out: Path | None,
    figure: Path | None,
    as_json: bool,
    said: Said,
    junit: Path | None = None,
) -> int:
    """Try gestures, files and folders (none named: the library), print what was found, and return the exit code."""
    from nao_sim.cli.progress import stages
    from nao_sim.gestures import GestureError, library
    from nao_sim.robot import joint_table

    if out is not None and not (fit and len(names) == 1 and not Path(names[0]).is_dir()):
        raise GestureError("--out needs --fit and exactly one gesture; give both or leave it out")
    joint_table().range_rad(limits)
    chosen, others = _files(names) if names else (list(library()), [])
    results = []
    with stages(hidden=as_json) as progress:
        for done, name in enumerate(chosen):
            results.append(_try(name, limits, fit, said, alone=len(chosen) == 1))
            progress("Validating", done + 1, len(chosen))
    found = [result.validation for result in results if result.validation is not None]
    if out is not None and found[0].trajectory is not None:
        from nao_sim.gestures import save_trajectory

        save_trajectory(found[0].trajectory, out)
    if figure is not None:
        _draw(found, figure)
    if junit is not None:
        from nao_sim.cli.junit import write_junit

        write_junit(results, limits, junit)
    rows = [_row(result, limits) for result in results]
    if as_json:
        typer.echo(json.dumps(rows, indent=2, ensure_ascii=False))
    else:
        _print(rows, limits, others, folders=any(Path(name).is_dir() for name in names))
    if any(result.error for result in results):
        return _ERROR
    return _INVALID if any(validation.faults for validation in found) else 0


def _files(names: list[str]) -> tuple[list[str], list[Path]]:
    """Return names with folders replaced by the motion files in them, and the files there that are none."""
    from nao_sim.gestures import GestureFileError
    from nao_sim.gestures.formats import SUFFIXES, holds_a_motion

    chosen: list[str] = []
    others: list[Path] = []
    for name in names:
        if not Path(name).is_dir():
            chosen.append(name)
            continue
        inside = [path for path in sorted(Path(name).rglob("*")) if path.is_file() and not _hidden(path, Path(name))]
        motions = [path for path in inside if path.suffix.lower() in SUFFIXES and holds_a_motion(path)]
        if not motions:
            raise GestureFileError(name, f"holds no motion file; known: {', '.join(SUFFIXES)}")
        chosen += map(str, motions)
        others += [path for path in inside if path not in set(motions)]
    return chosen, others


def _hidden(path: Path, folder: Path) -> bool:
    return any(part.startswith(".") for part in path.relative_to(folder).parts)


def _try(name: str, limits: str, fit: bool, said: Said, alone: bool) -> Result:
    """Validate one; of several, one that cannot be read does not stop the others."""
    from nao_sim.errors import NaoSimError
    from nao_sim.gestures.validation import validate_gesture

    begun = time.perf_counter()
    try:
        validation = validate_gesture(name, limits, fit, said=said)
    except (NaoSimError, OSError) as error:
        if alone:
            raise
        return Result(name, None, " ".join(str(error).split()).removeprefix(f"{name}: "), time.perf_counter() - begun)
    return Result(name, validation, None, time.perf_counter() - begun)


def _row(result: Result, limits: str) -> dict[str, Any]:
    from nao_sim.cli.motion_table import as_dict

    row: dict[str, Any] = {"gesture": result.name, "limits": limits}
    validation = result.validation
    if validation is None:
        return row | {"error": result.error, "changes": [], "faults": [], "violations": [], "notes": []}
    measured = {} if validation.measures is None else as_dict(validation.measures)
    return {
        **row,
        **measured,
        "changes": [str(change) for change in validation.changes],
        "faults": validation.faults,
        "violations": [asdict(entry) for entry in validation.violations],
        "notes": list(validation.notes),
    }


def _draw(found: list[Validation], figure: Path) -> None:
    from nao_sim.gestures import GestureError
    from nao_sim.gestures.range_picture import draw_range_use

    use = {entry.name: entry.measures.range_use for entry in found if entry.measures is not None}
    if not use:
        raise GestureError(f"{figure} is not drawn: no motion could be played")
    try:
        draw_range_use(use, figure)
    except ValueError as error:
        raise GestureError(f"{figure} cannot be drawn: {error}") from None


def _print(rows: list[dict[str, Any]], limits: str, others: list[Path], folders: bool) -> None:
    from rich.console import Console
    from rich.markup import escape

    from nao_sim.cli.motion_options import tell
    from nao_sim.cli.motion_table import LEGEND, table_of

    console = Console(soft_wrap=True, highlight=False)
    console.print(table_of(rows))
    console.print(LEGEND)
    for row in rows:
        name = escape(row["gesture"])
        if "error" in row:
            console.print(f"[red]{name}[/]: {escape(row['error'])}")
        for fault in row["faults"]:
            console.print(f"[red]{name}[/]: {escape(fault)}")
        for change in row["changes"]:
            console.print(f"{name}: changed {escape(change)}")
    if len(rows) > 1 or folders:
        unread = sum("error" in row for row in rows)
        failed = sum(bool(row["faults"]) for row in rows)
        passed = len(rows) - unread - failed
        console.print(f"{passed} pass, {failed} do not, {unread} cannot be read; limits: {limits}")
    if others:
        shown = ", ".join(escape(path.name) for path in others[:6]) + (", …" if len(others) > 6 else "")
        console.print(f"{len(others)} other files are no motions: {shown}")
    for row in rows if len(rows) <= 3 else []:
        tell(row["notes"], row["gesture"])
