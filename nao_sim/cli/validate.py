"""``nao-sim validate``: the proof that the model keeps its documented limits."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nao_sim.robot.validation import JointReport

EXIT_INVALID = 1


def validate(
    model: Annotated[bool, typer.Option("--model", help="Drive every joint of the robot model to both ends.")] = False,
    mjcf: Annotated[Path | None, typer.Option(help="Somebody else's NAO instead of ours (an MJCF file).")] = None,
    limits: Annotated[str, typer.Option(help="The limits to hold it to: thesis or v5.")] = "thesis",
    figure: Annotated[Path | None, typer.Option(help="Draw the ranges into this picture.")] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the measurements as JSON.")] = False,
) -> None:
    """Measure what the documentation promises; exit code 1 where it is not kept."""
    from nao_sim.robot.range_figure import draw_ranges
    from nao_sim.robot.validation import validate_model

    if not model and mjcf is None:
        raise typer.BadParameter("say what to validate: --model")
    reports = validate_model(mjcf, limits)
    if figure is not None:
        draw_ranges(reports, figure, f"{mjcf.name if mjcf else 'nao.xml'}, {limits} limits")
    valid = not any(report.problems for report in reports)
    if as_json:
        rows = [report.as_dict() for report in reports]
        typer.echo(json.dumps({"limits": limits, "valid": valid, "joints": rows}, indent=2))
    else:
        _print(reports)
    if not valid:
        raise typer.Exit(EXIT_INVALID)


def _print(reports: Sequence[JointReport]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("joint", no_wrap=True)
    for heading in ("documented", "reached", "past mrad", "speed", "torque Nm"):
        table.add_column(heading, justify="right", no_wrap=True)
    for r in reports:
        table.add_row(
            r.joint,
            _range(r.documented),
            _range(r.reached),
            "-" if r.peak_mrad is None else f"{r.peak_mrad:.2f}",
            "-" if r.speed is None else f"{r.speed:.0f}/{r.nominal_speed:.0f}",
            "-" if r.torque is None else f"{r.torque:.2f}/{r.torque_limit:.2f}",
        )
    console = Console()
    console.print(table)
    bad = [r for r in reports if r.problems]
    for r in bad:
        console.print(f"{r.joint}: {'; '.join(r.problems)}", soft_wrap=True)
    console.print(f"{len(reports)} joints, {len(bad)} with problems")


def _range(pair: tuple[float, float] | None) -> str:
    return "-" if pair is None else f"{pair[0]:.1f} .. {pair[1]:.1f}"
