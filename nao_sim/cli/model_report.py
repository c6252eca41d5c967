"""The model part of ``nao-sim validate``: the joint reports as a table or as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from nao_sim.robot.validation import JointReport


def validate_model_file(mjcf: Path | None, limits: str, figure: Path | None, as_json: bool) -> bool:
    """Measure a robot model, print what was found, and return whether it keeps its documentation."""
    from nao_sim.robot.range_figure import draw_ranges
    from nao_sim.robot.validation import validate_model

    reports = validate_model(mjcf, limits)
    if figure is not None:
        draw_ranges(reports, figure, f"{mjcf.name if mjcf else 'nao.xml'}, {limits} limits")
    valid = not any(report.problems for report in reports)
    if as_json:
        rows = [report.as_dict() for report in reports]
        typer.echo(json.dumps({"limits": limits, "valid": valid, "joints": rows}, indent=2))
    else:
        _print(reports)
    return valid


def _print(reports: Sequence[JointReport]) -> None:
    from rich.console import Console
    from rich.table import Table

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("joint", no_wrap=True)
    for heading in ("documented", "reached", "mrad", "speed", "torque"):
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
    console.print(
        "degrees, hands in per cent open; mrad: past the limit; speed: of nominal; torque in Nm: of its limit"
    )
    bad = [r for r in reports if r.problems]
    for r in bad:
        console.print(f"{r.joint}: {'; '.join(r.problems)}", soft_wrap=True)
    console.print(f"{len(reports)} joints, {len(bad)} with problems")


def _range(pair: tuple[float, float] | None) -> str:
    return "-" if pair is None else f"{pair[0]:.1f} .. {pair[1]:.1f}"
