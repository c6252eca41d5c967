"""``nao-sim convert``: a motion file in another format."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from nao_sim.cli.motion_options import FILES, Longest, Measured, Part, Units, said_of, tell


def convert(
    source: Annotated[str, typer.Argument(help=f"A motion file ({FILES}) or a gesture's name.")],
    target: Annotated[Path, typer.Argument(help="FILE.motion, .csv, .py, .xar, .pos, .json, .toml or .parquet.")],
    units: Units = None,
    longest: Longest = None,
    part: Part = None,
    measured: Measured = False,
) -> None:
    """Write the keys of SOURCE as TARGET, neither clipped nor slowed, and say what is not carried over."""
    from nao_sim.gestures.formats import save_curves
    from nao_sim.gestures.formats.converting import curves_of_file

    curves, notes = curves_of_file(source, said_of(units, longest, part, measured))
    lost = save_curves(curves, target)
    tell([*notes, *lost])
    last = max(float(curve.times[-1]) for curve in curves.values())
    typer.echo(f"{target}: {len(curves)} joints, {last:.2f} s; not held to any joint ranges (nao-sim validate does)")
