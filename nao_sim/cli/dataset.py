"""``nao-sim dataset``: verify a data set, or make one of one's own recordings."""

from __future__ import annotations

import typer

dataset = typer.Typer(no_args_is_help=True, help="Verify a data set, or make one of your own recordings.")
