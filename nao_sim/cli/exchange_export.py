"""``nao-sim exchange export``."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import typer

export = typer.Typer(no_args_is_help=True, help="Write a session for another tool.")

_Places = Annotated[list[Path], typer.Argument(metavar="DIR... OUT", help="Folders of played sessions; then the file.")]


def _say(lines: list[str], out: Path) -> None:
    from rich.console import Console
    from rich.markup import escape

    console = Console(soft_wrap=True)
    for line in lines:
        console.print(f"[yellow]note[/] {escape(line)}")
    console.print(f"written {escape(str(out))}")


def _now() -> str:
    from datetime import datetime

    return datetime.now().astimezone().isoformat(timespec="seconds")


@export.command()
def elan(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of one played session.")],
    out: Annotated[
        Path, typer.Argument(metavar="FILE.eaf", help="One that is there keeps everything and gets what it lacks.")
    ],
) -> None:
    """Write a session as an ELAN file (EAF 3.0)."""
    from nao_sim.exchange.elan import export_eaf, parse_eaf
    from nao_sim.exchange.files import write_whole
    from nao_sim.game.study import gather

    found = gather([folder])
    base = parse_eaf(str(out), out.read_bytes()) if out.exists() else None
    session = found.tables.sessions[0]
    film = found.folders[session.session] / session.film if session.film else None
    content, notes = export_eaf(found.tables, _now(), film, out.absolute().parent, base)
    write_whole(out, content)
    _say([*found.notes, *notes], out)


@export.command()
def boris(places: _Places) -> None:
    """Write sessions as the observations of a BORIS project."""
    from nao_sim.exchange.boris import export_boris
    from nao_sim.exchange.boris.media import media_facts
    from nao_sim.exchange.files import write_whole
    from nao_sim.game.study import gather

    folders, out = _split(places)
    _refuse(out)
    found = gather(folders)
    media, notes = {}, list(found.notes)
    for session in found.tables.sessions:
        if session.film:
            film = found.folders[session.session] / session.film
            facts = media_facts(film)
            if facts is None:
                notes.append(f"{film} cannot be read as a film; {session.session} becomes a live observation")
            else:
                media[session.session] = (film, facts)
    write_whole(out, export_boris(found.tables, _now(), media))
    _say(notes, out)


@export.command()
def bids(places: _Places) -> None:
    """Write sessions as a BIDS data set of behaviour: events.tsv with their sidecars."""
    from nao_sim.exchange.bids import write_bids
    from nao_sim.game.study import gather

    folders, out = _split(places)
    found = gather(folders)
    write_bids(out, found.tables)
    _say(list(found.notes), out)


@export.command()
def csv(
    places: _Places,
    table: Annotated[str, typer.Option(help="sessions, turns, ratings or events.")] = "turns",
    delimiter: Annotated[str, typer.Option(help="Between cells: , ; | or tab.")] = ",",
    decimal: Annotated[str, typer.Option(help="Before decimals: . or ,")] = ".",
    bom: Annotated[bool, typer.Option("--bom", help="Begin with a byte-order mark, as Excel likes it.")] = False,
    clock: Annotated[bool, typer.Option("--clock", help="Times as hh:mm:ss.mmm.")] = False,
) -> None:
    """Write one table of the sessions as CSV in your dialect."""
    from nao_sim.exchange.csv_dialects import Dialect, write_sheet
    from nao_sim.exchange.errors import ExchangeError
    from nao_sim.exchange.files import write_whole
    from nao_sim.game.study import gather
    from nao_sim.game.tables.schema import kind_of

    folders, out = _split(places)
    _refuse(out)
    dialect = Dialect("\t" if delimiter == "tab" else delimiter, decimal, bom, clock)
    if delimiter == decimal:
        raise ExchangeError(f"{delimiter!r} cannot divide cells and decimals both; choose another --delimiter")
    kind = kind_of(check_table(table))
    found = gather(folders)
    write_whole(out, write_sheet(kind, getattr(found.tables, table), dialect))
    _say(list(found.notes), out)


@export.command()
def dream(
    folder: Annotated[Path, typer.Argument(metavar="DIR", help="Folder of one played session.")],
    joints: Annotated[Path, typer.Argument(metavar="JOINTS.csv", help="The child's joints, a sample a line.")],
    out: Annotated[Path, typer.Argument(metavar="FILE.json")],
    participant: Annotated[int, typer.Option(help="The child's number, since DREAM takes no pseudonym.")],
    metres: Annotated[bool, typer.Option("--metres", help="Positions are metres, not millimetres.")] = False,
) -> None:
    """Write a filmed child's joints as DREAM 1.1; joints that were not tracked are null."""
    from dataclasses import replace

    from nao_sim.exchange.csv_dialects import read_sheet
    from nao_sim.exchange.dream import dream_bytes, dream_document
    from nao_sim.exchange.errors import ExchangeError
    from nao_sim.exchange.files import write_whole
    from nao_sim.exchange.joints import track_from
    from nao_sim.game.study import gather

    _refuse(out)
    found = gather([folder])
    if len(found.tables.sessions) != 1:
        raise ExchangeError(f"{folder} holds {len(found.tables.sessions)} sessions; name one session's folder")
    session = found.tables.sessions[0]
    track = track_from(read_sheet(str(joints), joints.read_bytes()), metres)
    track = replace(track, extra={"nao_sim_session": session.session})
    write_whole(out, dream_bytes(dream_document(track, participant, session.condition, "imitation", session.started)))
    _say(list(found.notes), out)


def check_table(name: str) -> str:
    """Return the name of a table, or say which there are."""
    from nao_sim.errors import did_you_mean
    from nao_sim.exchange.errors import ExchangeError
    from nao_sim.game.tables.schema import TABLES

    if name not in TABLES:
        raise ExchangeError(f"there is no table {name!r}{did_you_mean(name, TABLES)}")
    return name


def _split(places: list[Path]) -> tuple[list[Path], Path]:
    from nao_sim.exchange.errors import ExchangeError

    if len(places) < 2:
        raise ExchangeError("name the sessions' folders, and at the end the file or folder to write")
    return places[:-1], places[-1]


def _refuse(out: Path) -> None:
    from nao_sim.exchange.errors import ExchangeError

    if out.exists():
        raise ExchangeError(f"{out} is there already; name a new file, or take it away first")
