"""``nao-sim film``: render a labelled data set of simulated persons."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Annotated

import typer
from rich.progress import BarColumn, MofNCompleteColumn, Progress, TextColumn, TimeRemainingColumn, track

from nao_sim.people.datasets import dataset
from nao_sim.people.datasets.samples import film_samples, sample_labels


def film(
    out: Annotated[Path, typer.Option(help="Folder of the data set; what stands there is kept and completed.")],
    persons: Annotated[int, typer.Option(help="How many persons; every third is a child.")] = 12,
    takes: Annotated[int, typer.Option(help="Clips of each class by each person.")] = 2,
    seed: Annotated[int, typer.Option(help="The same seed gives the same pixels.")] = 0,
    classes: Annotated[
        list[str] | None,
        typer.Option(help="Only these classes, separated by commas or each with its own --classes; else all dynamic."),
    ] = None,
    irrelevant: Annotated[int, typer.Option(help="Clips of motions that are no gesture.")] = 0,
    restless: Annotated[
        float | None, typer.Option(help="Share of clips in which people cannot keep still; one in ten if not given.")
    ] = None,
    processes: Annotated[int, typer.Option(help="How many render at once; 0 for one a core.", min=0)] = 0,
    samples: Annotated[bool, typer.Option("--samples", help="Film the sample clips of assets/clips instead.")] = False,
) -> None:
    """Film simulated persons performing the gestures: a data set with manifest and card."""
    if samples:
        names = list(track(film_samples(out), "filming", total=len(sample_labels())))
        typer.echo(f"{len(names)} samples in {out}")
        return
    labels = [label.strip() for names in classes or () for label in names.split(",") if label.strip()]
    jobs = dataset.plan(persons, takes, seed, labels or None, irrelevant, restless)
    columns = (TextColumn("{task.description}"), BarColumn(), MofNCompleteColumn(), TimeRemainingColumn())
    frames = 0
    with Progress(*columns) as progress:
        task = progress.add_task("filming", total=len(jobs))

        def done(count: int) -> None:
            nonlocal frames
            frames += count
            progress.advance(task)

        dataset.film(jobs, out, processes or os.cpu_count() or 1, done)
    command = {
        "persons": persons,
        "takes": takes,
        "seed": seed,
        "classes": labels or None,
        "irrelevant": irrelevant,
        "restless": restless,
    }
    dataset.write_card(out, command, jobs)
    typer.echo(f"{len(jobs)} clips in {out}, {frames} frames rendered now")
