"""What the commands do with photos of hand postures instead of videos."""

from __future__ import annotations

import functools
import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import typer

if TYPE_CHECKING:
    from recognizer import Recognition
    from recognizer.evaluation.cross_validation import Evaluation

METHODS = "thesis_static,static"


def is_photo_set(dataset: Path) -> bool:
    """Whether a data set folder, or a database, is of photos and not of videos.

    Raises:
        DatabaseError: neither can be read.
    """
    from recognizer import Database
    from recognizer.evaluation.dataset import read_manifest
    from recognizer.postures.learning.methods import METHODS as known
    from recognizer.video.clip import STILL_SUFFIXES

    if dataset.is_file():
        return Database.load(dataset).method in known
    return all(entry.path.suffix.lower() in STILL_SUFFIXES for entry in read_manifest(dataset))


def recognize_photo(
    photo: Path, database: Path | None, among: list[str] | None = None, explain: Path | None = None
) -> Recognition:
    """Name the posture on a photo; with ``explain``, draw every stage into that folder."""
    from nao_sim.resources import resource
    from recognizer.postures import PhotoRecognizer
    from recognizer.postures.explain import explain_photo

    recognizer = PhotoRecognizer.load(database or resource("assets", "databases", "static.parquet"))
    answer = recognizer.recognize(photo, among)
    if explain is not None:
        explain_photo(photo, recognizer, explain)
    return answer


def train_photos(dataset: Path, out: Path, method: str, as_json: bool = False) -> None:
    """Learn from a folder of labelled photos, write the database and say what is in it."""
    database = _described(dataset, method, as_json)
    database.save(out)
    unused = database.provenance["without_a_hand"]
    summary: dict[str, Any] = {
        "database": str(out),
        "method": method,
        "photos": len(database),
        "left_out": len(unused),
        "persons": len(set(database.persons.tolist())),
        "postures": sorted(set(database.labels.tolist()) - {"irrelevant"}),
        "bytes": out.stat().st_size,
    }
    if as_json:
        typer.echo(json.dumps(summary))
        return
    for name in unused:
        typer.echo(f"left out, no hand found: {name}", err=True)
    typer.echo(
        f"{out}: {summary['photos']} photos of {summary['persons']} persons, {len(summary['postures'])} postures, "
        f"{summary['bytes'] / 1e6:.2f} MB, method {method}"
    )


def evaluate_photos(dataset: Path, protocol: str, methods: str, hidden: bool) -> list[Evaluation]:
    """Score a folder of photos, or a database of them, by each method.

    Photos in which a method finds no hand are counted on standard error and left out of its score.
    """
    from nao_sim.cli.progress import stages
    from recognizer import Database
    from recognizer.postures.evaluation import evaluate

    out = []
    for method in methods.split(","):
        database = Database.load(dataset) if dataset.is_file() else _described(dataset, method.strip(), hidden)
        unused = database.provenance.get("without_a_hand", [])
        if unused:
            typer.echo(f"{database.method}: no hand found in {len(unused)} photos, left out: {unused[0]} ...", err=True)
        with stages(hidden) as show:
            out.append(evaluate(database, protocol, functools.partial(show, f"{protocol}, {database.method}")))
        if dataset.is_file():
            break
    return out


def _described(dataset: Path, method: str, hidden: bool) -> Any:
    from nao_sim.cli.progress import stages
    from recognizer.evaluation.dataset import read_manifest
    from recognizer.postures import learn_from_photos

    with stages(hidden) as show:
        return learn_from_photos(read_manifest(dataset), method, functools.partial(show, f"describing, {method}"))
