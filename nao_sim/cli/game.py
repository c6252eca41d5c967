"""``nao-sim game``: play a session of the imitation game."""

from __future__ import annotations

import json
import shlex
import subprocess
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

if TYPE_CHECKING:
    from rich.console import Console

    from nao_sim.game.play import Say
    from nao_sim.game.session import SessionFile
    from nao_sim.game.tables import Tables, Turn

NEW = "session.toml"


def game(
    session: Annotated[
        Path | None, typer.Argument(help="The session file.  [with --new: session.toml]", show_default=False)
    ] = None,
    out: Annotated[
        Path | None,
        typer.Option(help="Folder for the session.  [default: the session's name]", show_default=False),
    ] = None,
    new: Annotated[bool, typer.Option("--new", help="Write a commented session file, which can be played.")] = False,
    resume: Annotated[
        bool, typer.Option("--resume", help="Go on with the session in --out; SESSION may be left out.")
    ] = False,
    among: Annotated[
        str | None,
        typer.Option(help="What the recogniser decides between: NAME,NAME,… or all.", show_default=False),
    ] = None,
    say: Annotated[
        str | None,
        typer.Option(help="A program that speaks; each sentence is its last argument.", show_default=False),
    ] = None,
    as_json: Annotated[bool, typer.Option("--json", help="Print session and turns as JSON.")] = False,
) -> None:
    """Play SESSION: orientation, baseline, game and closing, into a folder that survives a kill at any moment."""
    if new:
        _write_new(session or Path(NEW))
        return
    from rich.console import Console

    from nao_sim.cli.progress import stages
    from nao_sim.game.play import play

    agreed, folder = _agreed(session, out, resume, among)
    console = Console(soft_wrap=True)
    show: Callable[[Turn], None] = (lambda turn: None) if as_json else (lambda turn: _print_turn(console, turn))
    try:
        with stages(hidden=as_json) as progress:
            tables = play(agreed, folder, resume=resume, say=_speaker(say), progress=progress, told=show)
    except KeyboardInterrupt:
        typer.echo(f"nao-sim: stopped; go on with: nao-sim game --resume --out {shlex.quote(str(folder))}", err=True)
        raise typer.Exit(2) from None
    if as_json:
        typer.echo(json.dumps(_plain(tables, folder), indent=2, ensure_ascii=False))
    else:
        _print_end(console, tables, folder)


def _write_new(path: Path) -> None:
    from nao_sim.game.errors import GameError
    from nao_sim.resources import resource

    try:
        with path.open("x", encoding="utf-8") as file:
            file.write(resource("assets", "sessions", "groups_triadic.toml").read_text(encoding="utf-8"))
    except FileExistsError:
        raise GameError(f"{path} is there already; give another name, as nao-sim game --new my.toml") from None
    typer.echo(f"{path} written; play it with: nao-sim game {shlex.quote(str(path))}")


def _agreed(session: Path | None, out: Path | None, resume: bool, among: str | None) -> tuple[SessionFile, Path]:
    from dataclasses import replace

    from nao_sim.game.errors import GameError
    from nao_sim.game.session import read_session
    from nao_sim.game.session.reading import checked_among
    from nao_sim.game.store import SessionFolder

    if session is None and not (resume and out is not None):
        mend = "--resume needs --out DIR, the session's folder" if resume else "nao-sim game --new writes one"
        raise GameError(f"a session file is missing; {mend}")
    if resume and among is not None:
        raise GameError("--among was settled when the session began; leave it out with --resume")
    agreed = read_session(session) if session is not None else SessionFolder(out or Path()).agreed()
    if among is not None:
        agreed = replace(agreed, among=checked_among(among))
    return agreed, out or Path(agreed.name)


def _speaker(command: str | None) -> Say | None:
    """Return what speaks: a program of the user's."""
    if command is None:
        return None
    from nao_sim.game.errors import GameError

    words = shlex.split(command)

    def speak(text: str) -> None:
        try:
            subprocess.run([*words, text], check=True, capture_output=True, timeout=60)
        except (OSError, subprocess.SubprocessError) as error:
            raise GameError(f"--say {command}: {error}; give a program that speaks its last argument") from None

    speak("")
    return speak


def _print_turn(console: Console, turn: Turn) -> None:
    from rich.text import Text

    if turn.excluded is not None:
        how = f"no trial: {turn.excluded.replace('_', ' ')}"
    else:
        help_given = "" if not turn.prompt_level else f", help level {turn.prompt_level}"
        how = f"{turn.seen or 'nothing known seen'}, proposed {turn.auto_score}{help_given}"
    line = f"{turn.turn:3d}  {turn.phase:8s}  {turn.model} → {turn.imitator}  {turn.target}: {how}"
    console.print(Text(line, style="" if turn.imitator_role == "child" else "dim"))


def _print_end(console: Console, tables: Tables, folder: Path) -> None:
    from rich.text import Text

    trials = [turn for turn in tables.turns if turn.imitator_role == "child"]
    valid = [turn for turn in trials if turn.is_trial]
    good = [t for t in valid if (t.auto_score or 0) >= tables.sessions[0].success_at and not t.prompt_level]
    lines = [
        f"{len(good)} of {len(valid)} turns of the child answered without help, by the automatic proposal; "
        f"{len(trials) - len(valid)} no trial",
        f"written   {folder}",
        f"score     nao-sim score {folder} --rater R1",
        f"look      nao-sim review {folder}",
        f"report    nao-sim report {folder}",
    ]
    for line in lines:
        console.print(Text(line))


def _plain(tables: Tables, folder: Path) -> dict[str, object]:
    from dataclasses import asdict

    return {
        "session": asdict(tables.sessions[0]), "turns": [asdict(turn) for turn in tables.turns], "folder": str(folder),
    }  # fmt: skip
