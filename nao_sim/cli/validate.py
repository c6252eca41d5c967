"""``nao-sim validate``: can the robot do it, and does the model keep its documented limits?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

EXIT_INVALID = 1


def validate(
    gestures: Annotated[
        list[str] | None,
        typer.Argument(help="Gestures' names or files (.toml, .motion, .csv); none: the library.", show_default=False),
    ] = None,
    limits: Annotated[str, typer.Option(help="The joint ranges to hold them to: thesis, v5 or envelope.")] = "thesis",
    fit: Annotated[bool, typer.Option("--fit", help="Fit what asks for too much, and report the changes.")] = False,
    out: Annotated[
        Path | None, typer.Option(help="With --fit and one file: write the fitted motion here.", show_default=False)
    ] = None,
    model: Annotated[
        bool, typer.Option("--model", help="Instead: drive every joint of the robot model to both ends.")
    ] = False,
    mjcf: Annotated[
        Path | None, typer.Option(help="With --model: somebody else's NAO (an MJCF or URDF file).", show_default=False)
    ] = None,
    names: Annotated[
        Path | None,
        typer.Option(
            help="With --mjcf, where its joints are called otherwise: a table with lines like 'HeadYaw,head.yaw'.",
            show_default=False,
        ),
    ] = None,
    figure: Annotated[
        Path | None, typer.Option(help="Draw the use of the ranges: FILE.png.", show_default=False)
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the measurements as JSON.")] = False,
) -> None:
    """Play each gesture free-standing and measure it against ranges, motors, its own body and the ground.

    Exit code 1 if one does not pass.
    """
    if model or mjcf is not None:
        from nao_sim.cli.model_report import validate_model_file

        if gestures:
            raise typer.BadParameter("--model takes no gestures; validate them in a second command")
        valid = validate_model_file(mjcf, limits, figure, as_json, names)
    else:
        from nao_sim.cli.gesture_report import validate_gestures

        valid = validate_gestures(gestures or [], limits, fit, out, figure, as_json)
    if not valid:
        raise typer.Exit(EXIT_INVALID)
