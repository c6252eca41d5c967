"""The command table, and the one place where errors become a line and an exit code."""

from __future__ import annotations

import codecs
import importlib
import io
import json
import os
import sys
from typing import Annotated

import typer

from nao_sim import __version__
from nao_sim.errors import NaoSimError
from nao_sim.processes import Stopped, end_children, stopped_by_signals

# command -> module of nao_sim.cli that defines a function, or a Typer of sub-commands, of that name ('-' becomes '_')
COMMANDS = {
    "check": "check",
    "convert": "convert",
    "dataset": "dataset",
    "export": "export",
    "exchange": "exchange",
    "game": "game",
    "review": "review",
    "score": "score",
    "film": "film",
    "evaluate": "evaluate",
    "gestures": "gestures",
    "imitate": "imitate",
    "recognize": "recognize",
    "report": "report",
    "train": "train",
    "play": "play",
    "stress": "stress",
    "validate": "validate",
}

EXIT_ERROR = 2


def _app(names: list[str]) -> typer.Typer:
    """Build the command line; only the modules of ``names`` are imported."""
    # Without markup: "[s]" and "[default: …]" in a help text are meant as they stand.
    app = typer.Typer(
        no_args_is_help=True,
        add_completion=False,
        pretty_exceptions_enable=False,
        rich_markup_mode=None,
        context_settings={"help_option_names": ["-h", "--help"]},
    )

    @app.callback()
    def _root(
        version: Annotated[
            bool, typer.Option("--version", callback=_tell_version, is_eager=True, help="Print the version and exit.")
        ] = False,
    ) -> None:
        """Gesture video in, a simulated NAO's imitation and its recording out."""

    for name in names:
        module = importlib.import_module(f"nao_sim.cli.{COMMANDS[name]}")
        command = getattr(module, name.replace("-", "_"))
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=name)
        else:
            app.command(name)(command)
    return app


def _tell_version(asked: bool) -> None:
    if asked:
        typer.echo(f"nao-sim {__version__}")
        raise typer.Exit


def _user_errors() -> tuple[type[Exception], ...]:
    from recognizer.errors import RecognizerError

    return (NaoSimError, RecognizerError, OSError)


def _line(error: Exception) -> str:
    """Say an error in one line; what the system says of a file gets a mend."""
    if isinstance(error, OSError) and error.filename is not None and not isinstance(error, NaoSimError):
        return f"{error.filename}: {error.strerror}; choose another place or check its permissions"
    if isinstance(error, OSError) and not isinstance(error, NaoSimError) and error.strerror:
        return error.strerror
    return " ".join(str(error).split())


def main() -> None:
    """Run the command line; errors a user can mend are one line on standard error, exit code 2."""
    # OpenCV's own warnings would come before our one line; it reads this when it is first imported.
    os.environ.setdefault("OPENCV_LOG_LEVEL", "ERROR")
    _speak_any_alphabet()
    asked = sys.argv[1] if len(sys.argv) > 1 else ""
    names = [asked] if asked in COMMANDS else sorted(COMMANDS)
    try:
        with stopped_by_signals():
            _app(names)()
    except Stopped as stop:
        end_children()
        typer.echo("nao-sim: stopped", err=True)
        raise SystemExit(stop.exit_code) from None
    except _user_errors() as error:
        typer.echo(f"nao-sim: {_line(error)}", err=True)
        raise SystemExit(EXIT_ERROR) from None


def _speak_any_alphabet() -> None:
    """Let a terminal or pipe that knows no "°" or "é" get them as JSON writes them, instead of failing."""

    def as_json(error: UnicodeError) -> tuple[str, int]:
        if not isinstance(error, UnicodeEncodeError):
            raise error
        missing = error.object[error.start : error.end]
        return json.dumps(missing)[1:-1], error.end

    codecs.register_error("as_json", as_json)
    for stream in (sys.stdout, sys.stderr):
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="as_json")
