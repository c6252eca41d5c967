"""A rater's screen: clips in one Rerun viewer, or in a player of their own."""

from __future__ import annotations

import shlex
import socket
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Protocol

import cv2
import numpy as np

from nao_sim.game.errors import GameError
from nao_sim.game.scoring.sitting import Item, extract, frames_of


class Screen(Protocol):
    """Shows clips."""

    def show(self, item: Item) -> None:
        """Show an item's film; nothing where nothing was filmed."""


class NoScreen:
    """Shows nothing: the rater has the clips elsewhere."""

    def show(self, item: Item) -> None:
        """Show nothing."""


class Player:
    """Another program, which gets a film of a name that tells nothing.

    Args:
        command: as typed; the film becomes its last argument.
    """

    def __init__(self, command: str) -> None:
        self._words = shlex.split(command)

    def show(self, item: Item) -> None:
        """Play an item and wait until the program ends.

        Raises:
            GameError: the program is missing or fails.
        """
        with tempfile.TemporaryDirectory(prefix="nao-sim-clip-") as work:
            film = Path(work) / f"clip_{item.position:02d}.avi"
            if not extract(item, film):
                return
            try:
                subprocess.run([*self._words, str(film)], check=True)
            except (OSError, subprocess.SubprocessError) as error:
                raise GameError(
                    f"--player {shlex.join(self._words)}: {error}; give a program that plays a film"
                ) from None


class RerunScreen:
    """One Rerun viewer, in which each clip is a recording.

    Args:
        port: of the viewer.
    """

    def __init__(self, port: int) -> None:
        self._url = f"rerun+http://127.0.0.1:{port}/proxy"

    def show(self, item: Item) -> None:
        """Send an item's frames; they play from the start."""
        import rerun as rr
        import rerun.blueprint as rrb

        stream = rr.RecordingStream("nao_sim_score", recording_id=f"clip_{item.position:02d}_{time.time_ns()}")
        stream.connect_grpc(
            self._url, default_blueprint=rrb.Blueprint(rrb.Spatial2DView(origin="clip"), collapse_panels=True)
        )
        stream.send_recording_name(f"clip {item.position}: asked {item.turn.target}")
        at = 0.0
        for frame, fps in frames_of(item):
            stream.set_time("time", duration=at)
            jpeg = cv2.imencode(".jpg", frame)[1]
            stream.log("clip", rr.EncodedImage(contents=np.asarray(jpeg).tobytes(), media_type="image/jpeg"))
            at += 1 / fps
        stream.disconnect()


@contextmanager
def rerun_screen() -> Iterator[RerunScreen]:
    """Open a viewer that only this computer reaches, and close it afterwards.

    Raises:
        GameError: the viewer cannot open a window.
    """
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        port = int(probe.getsockname()[1])
    command = [sys.executable, "-m", "rerun", "--bind", "127.0.0.1", "--port", str(port), "--hide-welcome-screen"]
    viewer = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    try:
        time.sleep(2.0)
        if viewer.poll() is not None:
            raise GameError("the Rerun viewer cannot open a window here; rate with --player PROGRAM or --sheet FOLDER")
        yield RerunScreen(port)
    finally:
        viewer.terminate()
        viewer.wait()
