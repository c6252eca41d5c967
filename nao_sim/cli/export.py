"""``nao-sim export``: a gesture for other programs and for the real robot."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer


def export(
    gesture: Annotated[str, typer.Argument(help="A gesture's name, or a .toml, .motion or .csv file.")],
    file: Annotated[Path, typer.Argument(help="FILE.motion (Webots), FILE.py (NAOqi script) or FILE.csv.")],
    speed: Annotated[float, typer.Option(help="2 is twice as fast, where the motors allow it.")] = 1.0,
    amplitude: Annotated[float, typer.Option(help="1.2 is a fifth larger.")] = 1.0,
    mirror: Annotated[bool, typer.Option("--mirror", help="Exchange left and right.")] = False,
    fit: Annotated[bool, typer.Option("--fit", help="Clip what leaves a range instead of refusing it.")] = False,
    limits: Annotated[str, typer.Option(help="Joint ranges to keep: thesis, v5 or envelope.")] = "thesis",
) -> None:
    """Write GESTURE as FILE; the suffix says the format."""
    from nao_sim.gestures import find_gesture, mirrored, prepare, save_trajectory
    from nao_sim.motion import check

    chosen = find_gesture(gesture, fit)
    chosen = mirrored(chosen) if mirror else chosen
    prepared = prepare(chosen, speed=speed, amplitude=amplitude, limits=limits)
    check(prepared.trajectory, limits)
    save_trajectory(prepared.trajectory, file)
    for change in prepared.changes:
        typer.echo(f"changed: {change}", err=True)
    typer.echo(f"{file}: {chosen.name}, {prepared.trajectory.duration:.2f} s")
