"""``nao-sim exchange import``."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from nao_sim.exchange.merged import Merged
    from nao_sim.game.tables import Tables

bring = typer.Typer(no_args_is_help=True, help="Merge what people did in another tool into a session.")

_Folder = Annotated[Path, typer.Argument(metavar="DIR", help="Folder of the played session.")]
_DryRun = Annotated[bool, typer.Option("--dry-run", help="Say what would change and change nothing.")]


def _say(merged: Merged, folder: Path, dry_run: bool) -> None:
    from rich.console import Console
    from rich.markup import escape

    from nao_sim.game.tables import write_tables

    if not dry_run:
        write_tables(folder, merged.tables)
    console = Console(soft_wrap=True)
    for line in merged.news:
        console.print(f"[green]new[/]  {escape(line)}")
    for line in merged.notes:
        console.print(f"[yellow]note[/] {escape(line)}")
    n = len(merged.news)
    console.print(
        f"{n} {'change' if n == 1 else 'changes'} " + ("found" if dry_run else f"merged into {escape(str(folder))}")
    )


def _now() -> str:
    from datetime import datetime

    return datetime.now().astimezone().isoformat(timespec="seconds")


@bring.command()
def elan(file: Annotated[Path, typer.Argument(metavar="FILE.eaf")], folder: _Folder, dry_run: _DryRun = False) -> None:
    """Merge an ELAN file: scores become ratings, everything else events; nothing is taken away."""
    from nao_sim.exchange.elan import merge_eaf, parse_eaf
    from nao_sim.game.tables import read_tables

    root = parse_eaf(str(file), file.read_bytes())
    _say(merge_eaf(read_tables(folder), root, _now()), folder, dry_run)


@bring.command()
def boris(
    file: Annotated[Path, typer.Argument(metavar="FILE.boris")], folder: _Folder, dry_run: _DryRun = False
) -> None:
    """Merge a BORIS project: observations named as sessions; scores become ratings, everything else events."""
    from nao_sim.exchange.boris import merge_boris, parse_boris
    from nao_sim.game.tables import read_tables

    project = parse_boris(str(file), file.read_bytes())
    _say(merge_boris(read_tables(folder), project, _now()), folder, dry_run)


@bring.command()
def csv(
    file: Annotated[Path, typer.Argument(metavar="FILE.csv")],
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of the session; made if it is new.")],
    table: Annotated[str, typer.Option(help="sessions, turns, ratings or events.")] = "turns",
    columns: Annotated[
        list[str] | None, typer.Option(metavar="OURS=THEIRS", help="Which column is which; repeat.")
    ] = None,
    constants: Annotated[
        list[str] | None, typer.Option("--set", metavar="OURS=VALUE", help="A value for every line; repeat.")
    ] = None,
    delimiter: Annotated[str | None, typer.Option(help="Between cells: , ; | or tab; none: found out.")] = None,
    decimal: Annotated[str | None, typer.Option(help="Before decimals: . or , ; none: found out.")] = None,
    milliseconds: Annotated[bool, typer.Option("--milliseconds", help="Plain times are milliseconds.")] = False,
    dry_run: _DryRun = False,
) -> None:
    """Add the lines of a CSV file in whatever dialect to a table."""
    from nao_sim.cli.exchange_export import check_table
    from nao_sim.exchange.csv_dialects import read_sheet
    from nao_sim.exchange.csv_dialects.joining import join_sheet
    from nao_sim.exchange.merged import Merged
    from nao_sim.game.tables import check_tables

    name, where = check_table(table), str(file)
    sheet = read_sheet(where, file.read_bytes(), "\t" if delimiter == "tab" else delimiter, decimal)
    there = _tables(folder)
    tables, new = join_sheet(there, name, sheet, _pairs("--columns", columns), _pairs("--set", constants), milliseconds)
    check_tables(tables)
    _say(Merged(tables, (f"{name}: {new} lines of {where}",) if new else (), ()), folder, dry_run)


def _tables(folder: Path) -> Tables:
    from nao_sim.game.tables import Tables, is_folder_of_tables, read_tables

    return read_tables(folder) if is_folder_of_tables(folder) else Tables((), ())


def _pairs(option: str, texts: list[str] | None) -> dict[str, str]:
    from nao_sim.exchange.errors import ExchangeError

    found = {}
    for text in texts or []:
        name, sign, value = text.partition("=")
        if not sign or not name:
            raise ExchangeError(f"{option} {text!r} is not NAME=VALUE")
        found[name.strip()] = value.strip()
    return found
