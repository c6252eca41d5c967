"""``nao-sim dataset``: verify a data set, or make one of one's own recordings."""

from __future__ import annotations

import json
from collections import Counter
from pathlib import Path
from typing import Annotated, Any

import cv2
import typer
from rich.console import Console
from rich.progress import track
from rich.table import Table

from nao_sim.people.datasets import checking, importing
from nao_sim.people.datasets.manifest import read_manifest

dataset = typer.Typer(no_args_is_help=True, help="Verify a data set, or make one of your own recordings.")
EXIT_PROBLEMS = 1


@dataset.command("check")
def check(
    folder: Annotated[Path, typer.Argument(help="The data set's folder.")],
    sheet: Annotated[
        Path | None, typer.Option(help="Where the contact sheet goes; beside the manifest by default.")
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the summary and the problems as JSON.")] = False,
) -> None:
    """Read every clip, list what is wrong, and draw a contact sheet; exit code 1 when something is."""
    rows = read_manifest(folder)
    console = Console(stderr=as_json)
    with console.status("reading clips") as status:
        read = 0

        def done() -> None:
            nonlocal read
            read += 1
            status.update(f"reading clips: {read} of {len(rows)}")

        problems = checking.check(folder, rows, done)
    picture = sheet or folder / "contact_sheet.png"
    readable = [row for row in rows if (folder / row["file"]).is_file()]
    if readable:
        cv2.imwrite(str(picture), checking.contact_sheet(folder, readable))
    if as_json:
        typer.echo(json.dumps(_summary(rows) | {"problems": [vars(p) for p in problems]}, indent=2))
    else:
        _print(console, rows, problems, picture)
    if any(not problem.warning for problem in problems):
        raise typer.Exit(EXIT_PROBLEMS)


@dataset.command("import")
def import_(
    source: Annotated[
        Path, typer.Argument(help="A folder <label>/<person>_<take>.mp4, or a table of frame ranges (.csv).")
    ],
    folder: Annotated[Path, typer.Argument(help="Where the manifest goes; the recordings stay where they are.")],
) -> None:
    """Make a data set of your own videos or photos, referring to them in place."""
    found = importing.find(source)
    made = list(track(importing.import_recordings(found, folder), "reading", total=len(found), transient=True))
    counts = _summary(made)
    typer.echo(
        f"{len(made)} clips of {counts['persons']} persons, {len(counts['labels'])} labels: {folder / 'manifest.csv'}"
    )


def _summary(rows: list[dict[str, Any]]) -> dict[str, Any]:
    """Numbers of clips, persons, and clips a label."""
    labels = Counter(row["label"] for row in rows)
    return {"clips": len(rows), "persons": len({row["person"] for row in rows}), "labels": dict(sorted(labels.items()))}


def _print(console: Console, rows: list[dict[str, Any]], problems: list[checking.Problem], picture: Path) -> None:
    table = Table("label", "clips", "persons", "frames", "seconds")
    for label in sorted({row["label"] for row in rows}):
        mine = [row for row in rows if row["label"] == label]
        frames = [int(row["end"]) - int(row["start"]) + 1 if row.get("end") is not None else 0 for row in mine]
        rates = [float(row.get("fps") or 0) for row in mine]
        timed = [count / rate for count, rate in zip(frames, rates, strict=True) if rate > 0]
        spread = f"{min(timed):.1f} to {max(timed):.1f}" if timed else ""
        table.add_row(label, str(len(mine)), str(len({row["person"] for row in mine})), str(sum(frames)), spread)
    console.print(table)
    for problem in problems:
        console.print(f"{'warning' if problem.warning else 'error'}: {problem.where}: {problem.text}", highlight=False)
    bad = sum(not problem.warning for problem in problems)
    console.print(f"{len(rows)} clips, {bad} errors, {len(problems) - bad} warnings; contact sheet: {picture}")
