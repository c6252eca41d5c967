"""``nao-sim gestures``: the library."""

from __future__ import annotations

import json
from typing import Annotated

import typer


def gestures(as_json: Annotated[bool, typer.Option("--json", help="Print the library as JSON.")] = False) -> None:
    """List the gestures the robot can perform: number, name, family, class, duration."""
    from nao_sim.gestures import library, vocabulary

    rows: list[dict[str, object]] = [
        {
            "number": gesture.number,
            "name": gesture.name,
            "family": gesture.family,
            "kind": gesture.kind,
            "class": gesture.communicative_class,
            "duration_s": None if gesture.duration_s is None else round(gesture.duration_s, 2),
            "mirror": gesture.mirror,
            "in_vocabulary": gesture.name in vocabulary(),
            "title": gesture.title,
        }
        for gesture in library().values()
    ]
    if as_json:
        typer.echo(json.dumps(rows, indent=2))
    else:
        _print(rows)


def _print(rows: list[dict[str, object]]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("no.", justify="right")
    for heading in ("name", "family", "class"):
        # A narrow terminal takes its room from the last column alone.
        table.add_column(heading, min_width=max(len(str(row[heading])) for row in rows))
    table.add_column("seconds", justify="right", min_width=len("seconds"))
    table.add_column("what it is", no_wrap=True, overflow="ellipsis")
    for row in rows:
        number = "" if row["number"] is None else str(row["number"])
        seconds = "steps" if row["duration_s"] is None else f"{row['duration_s']:.1f}"
        table.add_row(number, str(row["name"]), str(row["family"]), str(row["class"]), seconds, str(row["title"]))
    Console().print(table)
