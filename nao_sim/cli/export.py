"""``nao-sim export``: a gesture for other programs and for the real robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from nao_sim.cli.motion_options import FILES, Limits, Longest, Measured, Part, Units, said_of, tell


def export(
    gesture: Annotated[str, typer.Argument(help=f"A gesture's name, or a file ({FILES}).")],
    file: Annotated[
        Path,
        typer.Argument(help="FILE.motion (Webots), .py (NAOqi script), .csv, .xar, .pos, .json, .toml or .parquet."),
    ],
    speed: Annotated[float, typer.Option(help="2 is twice as fast, where the motors allow it.")] = 1.0,
    amplitude: Annotated[float, typer.Option(help="1.2 is a fifth larger.")] = 1.0,
    mirror: Annotated[bool, typer.Option("--mirror", help="Exchange left and right.")] = False,
    fit: Annotated[bool, typer.Option("--fit", help="Clip what leaves a range instead of refusing it.")] = False,
    limits: Limits = "thesis",
    units: Units = None,
    longest: Longest = None,
    part: Part = None,
    measured: Measured = False,
) -> None:
    """Write GESTURE as FILE; the suffix says the format."""
    from nao_sim.gestures import find_gesture, mirrored, prepare, save_trajectory
    from nao_sim.motion import check

    chosen = find_gesture(gesture, fit, limits, said_of(units, longest, part, measured))
    tell(chosen.notes)
    chosen = mirrored(chosen) if mirror else chosen
    prepared = prepare(chosen, speed=speed, amplitude=amplitude, limits=limits)
    check(prepared.trajectory, limits)
    tell(save_trajectory(prepared.trajectory, file))
    for change in prepared.changes:
        typer.echo(f"changed: {change}", err=True)
    typer.echo(f"{file}: {chosen.name}, {prepared.trajectory.duration:.2f} s")
