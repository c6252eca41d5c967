"""One Rerun recording in one file: opened, filled, closed, or removed when anything goes wrong."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

from nao_sim.errors import NaoSimError

if TYPE_CHECKING:
    import rerun as rr
    import rerun.blueprint as rrb

APPLICATION_ID = "nao_sim"
TIMELINE = "time"
"""Seconds since the first frame of the clip."""


class RecordingError(NaoSimError):
    """A recording that cannot be written."""


@contextmanager
def recording(path: Path, name: str, recording_id: str, blueprint: rrb.Blueprint) -> Iterator[rr.RecordingStream]:
    """Open a recording for writing and close it, or remove the file if it could not be completed.

    Wall-clock timelines are left out, so that two runs of one episode hold the same data.

    Args:
        path: the ``.rrd`` file; its folder must exist.
        name: what the viewer calls the recording.
        recording_id: identity of the recording; recordings of one id are merged by the viewer.
        blueprint: how the viewer lays it out at first sight.

    Raises:
        RecordingError: the file could not be written, e.g. the disk is full.
    """
    # Rerun's writer thread reports a full disk on standard error besides raising; one message is enough.
    os.environ.setdefault("RUST_LOG", "off")
    import rerun as rr

    # Its own properties would hold the wall clock.
    stream = rr.RecordingStream(APPLICATION_ID, recording_id=recording_id, send_properties=False)
    stream.set_log_time_enabled(False)
    stream.set_log_tick_enabled(False)
    done = False
    try:
        stream.save(path, default_blueprint=blueprint)
        stream.send_recording_name(name)
        yield stream
        stream.flush()
        stream.disconnect()
        done = True
    except RuntimeError as error:
        raise RecordingError(
            f"{path.name} could not be written ({error}); is the disk full or the folder read-only?"
        ) from None
    finally:
        if not done:
            path.unlink(missing_ok=True)
