"""``nao-sim recognize``: what did the person on this video or photo do?"""

from __future__ import annotations

import dataclasses
import functools
import json
from pathlib import Path
from typing import Annotated, Any

import typer


def recognize(
    video: Annotated[Path, typer.Argument(help="a video, or a photo of a hand posture")],
    frames: Annotated[str | None, typer.Option(help="FIRST:LAST frame, both included, as 6:44")] = None,
    among: Annotated[str | None, typer.Option(help="gestures the context allows, separated by commas")] = None,
    every: Annotated[bool, typer.Option("--all", help="find and answer every gesture of a long video")] = False,
    explain: Annotated[Path | None, typer.Option(help="folder for pictures of every intermediate stage")] = None,
    database: Annotated[Path | None, typer.Option(help="feature database; the shipped one if left out")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="print JSON")] = False,
) -> None:
    """Name the gesture of VIDEO, or say that it is none of the known ones."""
    from nao_sim.cli.photos import recognize_photo
    from nao_sim.cli.progress import stages
    from nao_sim.resources import resource
    from recognizer import Recognizer, open_clip, parse_frame_range

    clip = open_clip(video, parse_frame_range(frames) if frames else None)
    labels = [name.strip() for name in among.split(",")] if among else None
    if clip.still:
        _show([recognize_photo(video, database, labels, explain)], as_json, False)
        return
    recognizer = Recognizer.load(database or resource("assets", "databases", "dynamic.parquet"))
    with stages(hidden=as_json) as show:
        update = functools.partial(show, "reading frames")
        found = (
            recognizer.recognize_each(clip, labels, update) if every else [recognizer.recognize(clip, labels, update)]
        )
        answers = []
        for number, answer in enumerate(found, 1):
            if explain is not None:
                from recognizer.explain import explain as draw

                draw(answer, explain / f"{number:02d}" if every else explain)
            # Its pictures are not needed any more; those of a long session would not fit in memory.
            answers.append(dataclasses.replace(answer, evidence=None))
    _show(answers, as_json, every)


def _show(answers: list[Any], as_json: bool, every: bool) -> None:
    if as_json:
        plain = [answer.to_dict() for answer in answers]
        typer.echo(json.dumps(plain if every else plain[0]))
    else:
        _print(answers)


def _print(answers: list[Any]) -> None:
    from rich.console import Console
    from rich.table import Table

    console = Console()
    if not answers:
        console.print("no motion that could be a gesture")
        return
    table = Table("from [s]", "to [s]", "gesture", "family", "distance", "limit", "neighbours")
    for a in answers:
        shown = [n.action if n.label == "irrelevant" else n.label for n in a.neighbours[:3]]
        table.add_row(
            f"{a.start:.1f}", f"{a.end:.1f}", a.label or "[red]rejected", a.family,
            *((f"{a.distance:.2f}", f"{a.threshold:.2f}") if a.nearest else ("–", "–")), ", ".join(shown),
        )  # fmt: skip
    console.print(table)
    for a in answers:
        if a.rejected:
            console.print(f"{a.start:.1f} s: {a.reason}")
    for warning in dict.fromkeys(w for a in answers for w in a.warnings):
        console.print(f"warning: {warning}", style="yellow")
