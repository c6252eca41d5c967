"""One Rerun recording in one file: opened, filled, closed, or removed when anything goes wrong."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO, TYPE_CHECKING

from nao_sim.errors import NaoSimError

if TYPE_CHECKING:
    import rerun as rr
    import rerun.blueprint as rrb

APPLICATION_ID = "nao_sim"
_BLOCK = 1 << 20
_PATIENCE_S = 60.0
"""Handing over what is logged takes so long at most: then the writer is taken for dead."""


class RecordingError(NaoSimError):
    """A recording that cannot be written."""


class _Writer:
    """Writes what Rerun pours into a pipe to a file.

    Rerun's own file writer ends on a full disk, and what is logged afterwards waits for it for ever. This one keeps
    on emptying the pipe and remembers the error.
    """

    def __init__(self, file: IO[bytes]) -> None:
        self._file = file
        self._read, self._write = os.pipe()
        self.error: OSError | None = None
        self._thread = threading.Thread(target=self._pour, name="recording", daemon=True)
        self._thread.start()

    @property
    def place(self) -> str:
        """The path that Rerun writes to."""
        return f"/dev/fd/{self._write}"

    def opened(self) -> None:
        """Leave the pipe's writing end to Rerun alone, so that its closing is the end."""
        os.close(self._write)
        self._write = -1

    def _pour(self) -> None:
        with os.fdopen(self._read, "rb", buffering=0) as pipe:
            while block := pipe.read(_BLOCK):
                if self.error is None:
                    try:
                        self._file.write(block)
                    except OSError as error:
                        self.error = error
        try:
            self._file.close()
        except OSError as error:
            self.error = self.error or error

    def wait(self) -> None:
        """Wait until everything that came is written."""
        self._thread.join(_PATIENCE_S)

    def check(self) -> None:
        """Raise what went wrong while writing."""
        if self.error is not None:
            raise self.error


@contextmanager
def recording(path: Path, name: str, recording_id: str, blueprint: rrb.Blueprint) -> Iterator[rr.RecordingStream]:
    """Open a recording for writing and close it, or remove the file if it could not be completed.

    Wall-clock timelines are left out, so that two runs of one episode hold the same data.

    Args:
        path: the ``.rrd`` file; its folder must exist.
        name: what the viewer calls the recording.
        recording_id: identity of the recording; two files of one id are one recording to a viewer or catalog.
        blueprint: how the viewer lays it out at first sight.

    Raises:
        RecordingError: the file could not be written, e.g. the disk is full.
    """
    import rerun as rr

    # Its own properties would hold the wall clock.
    stream = rr.RecordingStream(APPLICATION_ID, recording_id=recording_id, send_properties=False)
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    done = False
    try:
        with _named(path):
            writer = _Writer(path.open("wb"))
            stream.save(writer.place, default_blueprint=blueprint)
            writer.opened()
        try:
            stream.send_recording_name(name)
            yield stream
            with _named(path):
                stream.flush(timeout_sec=_PATIENCE_S)
        finally:
            stream.disconnect()
            writer.wait()
        with _named(path):
            writer.check()
        done = True
    finally:
        if not done:
            path.unlink(missing_ok=True)


@contextmanager
def _named(path: Path) -> Iterator[None]:
    try:
        yield
    except (RuntimeError, OSError) as error:
        reason = error.strerror if isinstance(error, OSError) else error
        raise RecordingError(
            f"{path.name} could not be written ({reason}); is the disk full or the folder read-only?"
        ) from None
