"""The command table, and the one place where errors become a line and an exit code."""

from __future__ import annotations

import importlib
import os
import sys

import typer

from nao_sim.errors import NaoSimError

# command -> module of nao_sim.cli that defines a function, or a Typer of sub-commands, of that name ('-' becomes '_')
COMMANDS = {
    "check": "check",
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
    app = typer.Typer(no_args_is_help=True, add_completion=False, pretty_exceptions_enable=False)

    @app.callback()
    def _root() -> None:
        """Gesture video in, a simulated NAO's imitation and its recording out."""

    for name in names:
        module = importlib.import_module(f"nao_sim.cli.{COMMANDS[name]}")
        command = getattr(module, name.replace("-", "_"))
        if isinstance(command, typer.Typer):
            app.add_typer(command, name=name)
        else:
            app.command(name)(command)
    return app


def _user_errors() -> tuple[type[Exception], ...]:
    from recognizer.errors import RecognizerError

    return (NaoSimError, RecognizerError, OSError)


def _line(error: Exception) -> str:
    """Say an error in one line; what the system says of a file gets a mend."""
    if isinstance(error, OSError) and error.filename is not None and not isinstance(error, NaoSimError):
        return f"{error.filename}: {error.strerror}; choose another place or check its permissions"
    return " ".join(str(error).split())


def main() -> None:
    """Run the command line; errors a user can mend are one line on standard error, exit code 2."""
    # OpenCV's own warnings would come before our one line; it reads this when it is first imported.
    os.environ.setdefault("OPENCV_LOG_LEVEL", "ERROR")
    asked = sys.argv[1] if len(sys.argv) > 1 else ""
    names = [asked] if asked in COMMANDS else sorted(COMMANDS)
    try:
        _app(names)()
    except _user_errors() as error:
        typer.echo(f"nao-sim: {_line(error)}", err=True)
        raise SystemExit(EXIT_ERROR) from None
