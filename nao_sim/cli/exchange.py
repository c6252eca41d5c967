"""``nao-sim exchange``: other tools' files out and in."""

from __future__ import annotations

import typer

from nao_sim.cli.exchange_export import export
from nao_sim.cli.exchange_import import bring

exchange = typer.Typer(no_args_is_help=True, help="Sessions to ELAN, BORIS, DREAM, BIDS and CSV, and back.")
exchange.add_typer(export, name="export")
exchange.add_typer(bring, name="import")
