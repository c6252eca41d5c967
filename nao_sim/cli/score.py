"""``nao-sim score``: people's scores beside the automatic proposal, and how far they agree."""

from __future__ import annotations

import json
import sys
from contextlib import AbstractContextManager, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from nao_sim.game.agreement import PairAgreement, Panel
    from nao_sim.game.scoring.screen import Screen
    from nao_sim.game.scoring.sitting import Item, Sitting
    from nao_sim.game.tables import Tables


def score(
    session: Annotated[Path, typer.Argument(help="The session's folder.", show_default=False)],
    rater: Annotated[str | None, typer.Option(help="Your pseudonym.", show_default=False)] = None,
    blind: Annotated[bool, typer.Option("--blind", help="Shuffle the order and hide the condition.")] = False,
    again: Annotated[bool, typer.Option("--again", help="Also what you have rated before.")] = False,
    player: Annotated[
        str | None,
        typer.Option(help="Program that plays a film.  [default: the Rerun viewer; none: nothing]", show_default=False),
    ] = None,
    sheet: Annotated[
        Path | None, typer.Option(help="Write clips and a sheet to fill in into this folder.", show_default=False)
    ] = None,
    from_file: Annotated[
        Path | None, typer.Option("--from", help="Read the ratings of a filled sheet (CSV).", show_default=False)
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print what is confirmed, and agreement, as JSON.")] = False,
) -> None:
    """Rate SESSION's turns, or without --rater say what is not yet confirmed and how far raters agree."""
    from rich.console import Console

    from nao_sim.game.errors import GameError
    from nao_sim.game.scoring.sheet import read_sheet, write_sheet
    from nao_sim.game.scoring.sitting import sitting

    console = Console(soft_wrap=True)
    if rater is None and (sheet or from_file or blind or player):
        raise GameError("--rater is missing; give your pseudonym, as --rater R1")
    if rater is not None:
        mine = sitting(session, rater, blind)
        if sheet is not None:
            count = write_sheet(mine, sheet)
            typer.echo(
                f"{count} clips and {sheet / 'sheet.csv'} written; read it back with the same options and --from"
            )
            return
        if from_file is not None:
            typer.echo(f"{read_sheet(mine, from_file)} turns rated by {rater}", err=as_json)
        else:
            _sit(console, mine, mine.items if again else mine.open, player)
    _tell(console, session, as_json)


def _sit(console: Console, sitting: Sitting, items: tuple[Item, ...], player: str | None) -> None:
    """Show one clip after the other and take a key for each."""
    if not items:
        console.print(f"{sitting.rater} has rated all {len(sitting.items)} turns; --again shows them once more")
        return
    with _screen(player) as screen:
        for count, item in enumerate(items):
            if not _rate(console, screen, sitting, item):
                console.print(f"{len(items) - count} turns left; the same command goes on")
                return


def _screen(player: str | None) -> AbstractContextManager[Screen]:
    from nao_sim.game.scoring.screen import NoScreen, Player, rerun_screen

    if player is None:
        return rerun_screen()
    return nullcontext(NoScreen() if player == "none" else Player(player))


def _rate(console: Console, screen: Screen, sitting: Sitting, item: Item) -> bool:
    """Take the rating of one item; False: the rater stops."""
    from rich.text import Text

    from nao_sim.game.tables.words import EXCLUSIONS

    where = "" if sitting.blind else f"turn {item.turn.turn}, {item.turn.phase}, {item.turn.condition}: "
    nothing = "" if item.cuts else "  (nobody moved; nothing was filmed)"
    console.print(Text(f"{item.position} of {len(sitting.items)}  {where}asked {item.turn.target}{nothing}"))
    screen.show(item)
    while True:
        console.print(Text(f"  {', '.join(sitting.keys)} score, x no trial, r again, q stop: "), end="")
        key = _key()
        console.print(Text(key))
        if key in sitting.keys:
            sitting.say(item, int(key))
            return True
        if key == "r":
            screen.show(item)
        elif key == "x":
            reason = _reason(console, list(EXCLUSIONS))
            if reason is not None:
                sitting.say(item, None, reason)
                return True
        elif key in ("q", ""):
            return False


def _reason(console: Console, reasons: list[str]) -> str | None:
    from rich.text import Text

    shown = ", ".join(f"{k} {reason.replace('_', ' ')}" for k, reason in enumerate(reasons, 1))
    console.print(Text(f"  why: {shown}: "), end="")
    key = _key()
    console.print(Text(key))
    return reasons[int(key) - 1] if key.isdigit() and 1 <= int(key) <= len(reasons) else None


def _key() -> str:
    """One key at a terminal; elsewhere the first sign of a line, empty at the end."""
    import click

    if sys.stdin.isatty():
        return click.getchar().lower()
    return sys.stdin.readline().strip()[:1].lower()


def _tell(console: Console, session: Path, as_json: bool) -> None:
    """Say what is not yet confirmed, and how far raters agree."""
    from nao_sim.game.agreement import panel_of
    from nao_sim.game.store import SessionFolder

    folder = SessionFolder(session)
    folder.check_begun()
    with folder.claimed():
        tables = folder.write_tables()
    panel = panel_of(tables.turns, tables.ratings, tables.sessions[0].scale)
    if as_json:
        typer.echo(json.dumps(_plain(tables, panel), indent=2, ensure_ascii=False))
        return
    _print_agreement(console, panel)
    open_turns = _unconfirmed(tables)
    if open_turns:
        console.print(f"not yet confirmed by a person: turns {', '.join(open_turns)}")
    else:
        console.print("every trial is confirmed by a person")


def _unconfirmed(tables: Tables) -> list[str]:
    from nao_sim.game.tables.scores import accept, latest_ratings

    rated, primary = latest_ratings(tables.ratings), tables.sessions[0].primary_rater
    trials = [turn for turn in tables.turns if turn.is_trial]
    return [str(t.turn) for t in trials if not accept(t, rated.get(t.turn_id, {}), primary).confirmed]


def _print_agreement(console: Console, panel: Panel) -> None:
    from rich.table import Table
    from rich.text import Text

    for pair in (*panel.people, *panel.proposals):
        what = "proposal" if pair in panel.proposals else pair.first
        console.print(Text(f"{what} against {pair.second}: {pair.percent} of turns alike", style="bold"))
        table = Table("", *(f"{pair.second}: {s}" for s in pair.scores), show_edge=False)
        for s, counts in zip(pair.scores, pair.table, strict=True):
            table.add_row(f"{what}: {s}", *map(str, counts))
        console.print(table)
        for kappa in pair.kappas:
            console.print(Text(f"  {kappa.name}: {kappa.words}"))
        if pair.differ:
            console.print(Text(f"  scored differently: {', '.join(pair.differ)}"))
    if panel.people:
        console.print(Text(f"{panel.alpha.name}, all raters: {panel.alpha.words}"))


def _plain(tables: Tables, panel: Panel) -> dict[str, object]:
    from dataclasses import asdict

    def pair(p: PairAgreement) -> dict[str, object]:
        return {**asdict(p), "percent": p.percent}

    return {
        "session": tables.sessions[0].session,
        "unconfirmed": _unconfirmed(tables),
        "people": [pair(p) for p in panel.people],
        "proposals": [pair(p) for p in panel.proposals],
        "alpha": asdict(panel.alpha),
        "ratings": [asdict(rating) for rating in tables.ratings],
    }
