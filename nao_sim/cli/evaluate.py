"""``nao-sim evaluate``: how well are gestures named, and irrelevant motion rejected, on persons never seen?"""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import Annotated, Any

import typer

PASSING = 8  # irrelevant motions shown


def evaluate(
    dataset: Annotated[Path, typer.Argument(help="data set folder, or a database (.parquet) made by train")],
    protocol: Annotated[str, typer.Option(help="loo-person or k-fold")] = "loo-person",
    methods: Annotated[
        str | None,
        typer.Option(help="methods to compare, separated by commas; body, of photos thesis_static,static if left out"),
    ] = None,
    figures: Annotated[Path | None, typer.Option(help="folder for the figures of results")] = None,
    jobs: Annotated[int, typer.Option(help="processes", min=1)] = 2,
    as_json: Annotated[bool, typer.Option("--json", help="print one JSON object")] = False,
) -> None:
    """Score DATASET by models that never saw the person (or clip) they answer for."""
    from rich.console import Console

    from nao_sim.cli import photos

    console = Console(stderr=as_json)
    if photos.is_photo_set(dataset):
        evaluations = photos.evaluate_photos(dataset, protocol, methods or photos.METHODS, as_json)
    else:
        evaluations = _of_clips(dataset, protocol, methods or "body", jobs, as_json)
    if figures is not None:
        from recognizer.evaluation.figures import draw_figures

        for path in draw_figures(evaluations, figures):
            console.print(f"wrote {path}")
    if as_json:
        rows = {e.method: {**e.summary(), "by_k": e.by_k, "rejections": e.rejections()} for e in evaluations}
        typer.echo(json.dumps(rows))
    else:
        _print(console, evaluations)


def _of_clips(dataset: Path, protocol: str, methods: str, jobs: int, as_json: bool) -> list[Any]:
    from nao_sim.cli.progress import stages
    from nao_sim.cli.train import described
    from recognizer import Database
    from recognizer.evaluation.cross_validation import evaluate as score

    evaluations = []
    for method in methods.split(","):
        if dataset.is_file():
            database = Database.load(dataset)
        else:
            database, _ = described(dataset, method.strip(), jobs)
        with stages(as_json) as show:
            name = f"{protocol}, {database.method}"
            evaluations.append(score(database, protocol, functools.partial(show, name), jobs))
    return evaluations


def _print(console: Any, evaluations: list[Any]) -> None:
    from rich.table import Table

    table = Table("share", *(f"{e.method}, {e.protocol}" for e in evaluations))
    for row in evaluations[0].summary():
        table.add_row(row, *(f"{100 * e.summary()[row]:.1f} %" for e in evaluations))
    console.print(table)
    for evaluation in evaluations:
        irrelevant = set(evaluation.actions[~evaluation.gestures].tolist())
        passing = [(name, *row) for name, row in evaluation.rejections().items() if name in irrelevant and row[1] < 1]
        if passing:
            worst = Table(f"irrelevant, passing most ({evaluation.method})", "clips", "rejected", "taken for")
            for name, clips, rejected, taken_for in passing[:PASSING]:
                worst.add_row(name, str(clips), f"{100 * rejected:.0f} %", taken_for)
            console.print(worst)
