"""``nao-sim train``: a data set of labelled clips in, a feature database out."""

from __future__ import annotations

import hashlib
import json
from importlib.metadata import version
from pathlib import Path
from typing import Annotated, Any

import typer


def train(
    dataset: Annotated[Path, typer.Argument(help="folder with manifest.parquet or manifest.csv")],
    out: Annotated[Path, typer.Option(help="database to write (.parquet)")],
    method: Annotated[
        str | None, typer.Option(help="description: body or thesis, of photos static or thesis_static")
    ] = None,
    jobs: Annotated[int, typer.Option(help="processes", min=1)] = 2,
    as_json: Annotated[bool, typer.Option("--json", help="print one JSON object")] = False,
) -> None:
    """Describe every clip of DATASET and write the database that recognises gestures."""
    from rich.console import Console

    from nao_sim.cli.photos import is_photo_set, train_photos
    from recognizer import Recognizer

    if is_photo_set(dataset):
        train_photos(dataset, out, method or "static", as_json)
        return
    method = method or "body"
    console = Console(stderr=as_json)
    database, problems = described(dataset, method, jobs)
    recognizer = Recognizer.fit(database)
    recognizer.save(out)
    for problem in problems:
        console.print(f"left out: {problem}", style="yellow")
    size = out.stat().st_size
    summary = {
        "database": str(out),
        "method": method,
        "clips": len(database),
        "left_out": len(problems),
        "persons": len(set(database.persons.tolist())),
        "gestures": recognizer.labels,
        "bytes": size,
    }
    if summary["persons"] == 1:
        console.print(
            "one person cannot say how far persons differ: nothing will be rejected; film or import more",
            style="yellow",
        )
    if as_json:
        typer.echo(json.dumps(summary))
    else:
        console.print(
            f"{out}: {summary['clips']} clips of {summary['persons']} persons, "
            f"{len(recognizer.labels)} gestures, {size / 1e6:.2f} MB, method {method}"
        )


def described(dataset: Path, method: str, jobs: int) -> tuple[Any, list[str]]:
    """Build the feature database of a data set folder under a progress bar.

    Raises:
        DatabaseError: the data set cannot be used, or the method is unknown.
    """
    from nao_sim.cli.progress import stages
    from nao_sim.gestures.vocabulary import vocabulary
    from recognizer.evaluation.dataset import build_database, read_manifest

    entries = read_manifest(dataset)
    families = {name: entry.family for name, entry in vocabulary().items() if entry.family in ("small", "large")}
    with stages() as show:
        return build_database(
            entries,
            families,
            method,
            jobs,
            lambda done, total: show("describing clips", done, total),
            _provenance(dataset, method),
            {name: entry.mirror for name, entry in vocabulary().items() if name in families},
        )


def _provenance(dataset: Path, method: str) -> dict[str, Any]:
    """Say what the database was made of: command, package versions and the manifest's hash."""
    manifest = next(p for p in (dataset / "manifest.parquet", dataset / "manifest.csv") if p.is_file())
    card = dataset / "card.json"
    return {
        "command": f"nao-sim train {dataset.name} --method {method}",
        "manifest_sha256": hashlib.sha256(manifest.read_bytes()).hexdigest(),
        "card": json.loads(card.read_text()) if card.is_file() else None,
        "versions": {name: version(name) for name in ("nao-sim", "numpy", "scikit-learn")},
    }
