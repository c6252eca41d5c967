"""The model part of ``nao-sim validate``: the joint reports as a table or as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from nao_sim.robot.others import Found
    from nao_sim.robot.validation import JointReport


_WIDTH = 110


def validate_model_file(
    mjcf: Path | None, limits: str, figure: Path | None, as_json: bool, names: Path | None = None
) -> bool:
    """Say what a robot model is, measure what can be measured, and return whether it keeps its documentation.

    A model of which a part could not be measured does not: the answer is not known, and ``valid`` is null in JSON.
    """
    from nao_sim.robot.others import look, read_names
    from nao_sim.robot.range_figure import draw_ranges
    from nao_sim.robot.validation import validate_model

    found = None if mjcf is None else look(mjcf, None if names is None else read_names(names))
    if found is not None and not as_json:
        _say(found)
    reports = validate_model(mjcf, limits) if found is None else validate_model(mjcf, limits, found)
    if figure is not None:
        draw_ranges(reports, figure, f"{mjcf.name if mjcf else 'nao.xml'}, {limits} limits")
    wrong = any(report.problems for report in reports)
    open_ = any(report.unmeasured for report in reports)
    if as_json:
        answer = {"limits": limits, "valid": False if wrong else None if open_ else True}
        model = {} if found is None else {"model": found.as_dict()}
        rows = [report.as_dict() for report in reports]
        typer.echo(json.dumps({**answer, **model, "joints": rows}, indent=2))
    else:
        _print(reports, limits)
    return not wrong and not open_


def _say(found: Found) -> None:
    """Print what was found in somebody's model, before it is judged."""
    from rich.table import Table
    from rich.text import Text

    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(no_wrap=True, style="bold")
    table.add_column()
    for heading, sentence in found.lines():
        table.add_row(heading, Text(sentence))
    _console().print(table)


def _print(reports: Sequence[JointReport], limits: str) -> None:
    from rich.table import Table

    there = [r for r in reports if r.theirs is not None or r.compiled is not None] or list(reports)

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("joint", no_wrap=True)
    for heading in (f"'{limits}'", "its range", "reached", "mrad", "speed", "torque"):
        table.add_column(heading, justify="right", no_wrap=True)
    for r in there:
        table.add_row(
            r.joint,
            _range(r.documented),
            _range(r.compiled),
            "not measured" if r.unmeasured else _range(r.reached),
            "-" if r.peak_mrad is None else f"{r.peak_mrad:.2f}",
            "-" if r.speed is None else f"{r.speed:.0f}/{r.nominal_speed:.0f}",
            "-" if r.torque is None else f"{r.torque:.2f}/{r.torque_limit:.2f}",
        )
    console = _console()
    console.print(table)
    console.print(
        "degrees, hands in per cent open; mrad: past the limit; speed: of nominal; torque in Nm: of its limit"
    )
    for problems in dict.fromkeys(r.problems for r in there if r.problems):
        joints = ", ".join(r.joint for r in there if r.problems == problems)
        console.print(f"{joints}: {'; '.join(problems)}", soft_wrap=True, markup=False)
    missing = [r.joint for r in reports if r not in there]
    if missing:
        console.print(f"not in the model: {', '.join(missing)}", soft_wrap=True, markup=False)
    open_ = [r for r in reports if r.unmeasured]
    for reason in dict.fromkeys(r.unmeasured for r in open_):
        joints = ", ".join(r.joint for r in open_ if r.unmeasured == reason)
        console.print(f"{joints}: not measured, {reason}", soft_wrap=True, markup=False)
    bad = sum(bool(r.problems) for r in reports)
    count = f"{len(reports)} joints, {bad} with problems"
    console.print(count + (f", {len(open_)} not measured" if open_ else ""))


def _console() -> Console:
    """Return a console; a file or pipe, which has no width, gets one that the table fits."""
    from rich.console import Console

    console = Console(emoji=False)
    return console if console.is_terminal else Console(emoji=False, width=max(console.width, _WIDTH))


def _range(pair: tuple[float, float] | None) -> str:
    return "-" if pair is None else f"{pair[0]:.1f} .. {pair[1]:.1f}"
