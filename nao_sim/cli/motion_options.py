"""Options that every command with a motion file has, and what they mean together."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nao_sim.gestures.formats import Said

FILES = ".toml, .motion, .csv, .py, .xar, .pml, .pos, .json, .parquet or .rrd"

Limits = Annotated[str, typer.Option(help="Joint ranges to keep: thesis, v5 or envelope.")]
Units = Annotated[
    str | None,
    typer.Option(
        help="What a table does not say itself: rad or deg; s, ms, us or frames@25; clock. As in 'rad,ms'.",
        show_default=False,
    ),
]
Longest = Annotated[
    float | None, typer.Option(help="Seconds that a motion file may last; 300 if not given.", show_default=False)
]
Part = Annotated[
    str | None, typer.Option(help="Of several time lines or episodes in a file, this one.", show_default=False)
]
Measured = Annotated[bool, typer.Option("--measured", help="Of an episode: what the joints did, not what was asked.")]


def said_of(units: str | None, longest: float | None, part: str | None, measured: bool = False) -> Said:
    """Return the options as what the person says about the file."""
    from nao_sim.gestures.formats import said

    return said(units, longest, part, measured)


def tell(notes: tuple[str, ...] | list[str], name: str = "") -> None:
    """Print notes about a file on standard error, a line each."""
    for note in notes:
        typer.echo(f"note: {name}{': ' if name else ''}{note}", err=True)
