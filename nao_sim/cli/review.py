"""``nao-sim review``: look at episodes and sessions in Rerun."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Annotated
from urllib.parse import quote

import typer


def review(
    paths: Annotated[list[Path], typer.Argument(help="Folders of episodes or sessions.", show_default=False)],
    web: Annotated[bool, typer.Option("--web", help="Serve it to browsers on this computer.")] = False,
    port: Annotated[int, typer.Option(help="With --web: port of the page.", min=1, max=65535)] = 9090,
    list_only: Annotated[bool, typer.Option("--list", help="Only say which recordings would be opened.")] = False,
) -> None:
    """Open PATHS in the Rerun viewer: film and robot side by side, what happened as a time line below."""
    from nao_sim.game.review.gather import recordings

    with tempfile.TemporaryDirectory(prefix="nao-sim-review-") as work:
        files = [str(file) for file in recordings(paths, Path(work))]
        if list_only:
            typer.echo("\n".join(files))
            return
        # The viewer's own default listens on every network; a child's film stays on this computer.
        command = [sys.executable, "-m", "rerun", *files, "--bind", "127.0.0.1"]
        if web:
            stream = _free_port()
            command += ["--serve-web", "--web-viewer-port", str(port), "--port", str(stream)]
            source = quote(f"rerun+http://127.0.0.1:{stream}/proxy", safe="")
            typer.echo(f"open http://127.0.0.1:{port}?url={source} in a browser; Ctrl-C ends it")
        else:
            command += ["--port", "auto"]
        try:
            code = subprocess.run(command, check=False, env={"RUST_LOG": "error", **os.environ}).returncode
        except KeyboardInterrupt:
            code = 0
    if code:
        _say_failed(web, port)


def _free_port() -> int:
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return int(probe.getsockname()[1])


def _say_failed(web: bool, port: int) -> None:
    from nao_sim.game.errors import GameError

    if web:
        raise GameError(f"the page could not be served on port {port}; choose another with --port")
    raise GameError("the Rerun viewer could not open a window; serve the recording to a browser with --web")
