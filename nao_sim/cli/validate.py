"""``nao-sim validate``: can the robot do it, and does the model keep its documented limits?"""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

from nao_sim.cli.motion_options import FILES, Limits, Longest, Measured, Part, Units, said_of

EXIT_INVALID, EXIT_ERROR = 1, 2


def validate(
    gestures: Annotated[
        list[str] | None,
        typer.Argument(help=f"Names of gestures, files ({FILES}) or folders; none: the library.", show_default=False),
    ] = None,
    limits: Limits = "thesis",
    fit: Annotated[bool, typer.Option("--fit", help="Fit what asks for too much, and report the changes.")] = False,
    out: Annotated[
        Path | None, typer.Option(help="With --fit and one file: write the fitted motion here.", show_default=False)
    ] = None,
    units: Units = None,
    longest: Longest = None,
    part: Part = None,
    measured: Measured = False,
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
    junit: Annotated[
        Path | None, typer.Option(help="Write the results as JUnit: FILE.xml.", show_default=False)
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print the measurements as JSON.")] = False,
) -> None:
    """Play each gesture free-standing and measure it against ranges, motors, its own body and the ground.

    Exit code 1 if one does not pass, 2 if one cannot be read.
    """
    if model or mjcf is not None:
        from nao_sim.cli.model_report import validate_model_file

        if gestures or fit or out or units or longest or part or measured or junit:
            raise typer.BadParameter("--model takes no gestures nor their options; validate them in a second command")
        if not validate_model_file(mjcf, limits, figure, as_json, names):
            raise typer.Exit(EXIT_INVALID)
        return
    from nao_sim.cli.gesture_report import validate_gestures

    if names is not None:
        raise typer.BadParameter(
            "names the joints of somebody's model; give the model with --mjcf", param_hint="--names"
        )
    said = said_of(units, longest, part, measured)
    code = validate_gestures(gestures or [], limits, fit, out, figure, as_json, said, junit)
    if code:
        raise typer.Exit(code)
