"""``nao-sim gestures``: the library."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nao_sim.gestures import Gesture


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
            "duration_s": round(_duration_s(gesture), 2),
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


def _duration_s(gesture: Gesture) -> float:
    """Seconds of a gesture as written, or of the steps of a walk."""
    from nao_sim.motion.walking import plan_walk

    if gesture.walk is None:
        return float(gesture.duration_s or 0.0)
    return float(plan_walk(gesture.walk.x, gesture.walk.y, gesture.walk.turn).times[-1])


def _print(rows: list[dict[str, object]]) -> None:
    from rich.console import Console
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("no.", justify="right", min_width=3)
    for heading in ("name", "family", "class"):
        # A narrow terminal takes its room from the last column alone.
        table.add_column(heading, min_width=max(len(str(row[heading])) for row in rows))
    table.add_column("seconds", justify="right", min_width=len("seconds"))
    table.add_column("what it is", no_wrap=True, overflow="ellipsis")
    for row in rows:
        number = "" if row["number"] is None else str(row["number"])
        seconds = f"{row['duration_s']:.1f}"
        name, family, kind, title = (escape(str(row[key])) for key in ("name", "family", "class", "title"))
        table.add_row(number, name, family, kind, seconds, title)
    Console(emoji=False).print(table)
