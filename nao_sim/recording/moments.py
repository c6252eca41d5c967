"""Moments on the recording's time line: whole nanoseconds, however a thing is logged.

Rerun rounds a float of seconds to nanoseconds in ``set_time`` and cuts it off in ``TimeColumn``, so that a third of all
overlays at 30 frames a second would stand one nanosecond after the picture they belong to, and be shown with the next.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike, NDArray

if TYPE_CHECKING:
    import rerun as rr

TIMELINE = "time"
"""Seconds since the first frame of the clip."""


def nanoseconds(seconds: ArrayLike) -> NDArray[np.timedelta64]:
    """Return seconds, shape (n,), as whole nanoseconds, rounded."""
    return np.rint(np.asarray(seconds, dtype=float) * 1e9).astype("timedelta64[ns]")


def column(seconds: ArrayLike) -> list[rr.TimeColumn]:
    """Return the index of a column of values for ``send_columns``: seconds, shape (n,)."""
    import rerun as rr

    return [rr.TimeColumn(TIMELINE, duration=nanoseconds(seconds))]


@contextmanager
def moment(stream: rr.RecordingStream, seconds: float) -> Iterator[None]:
    """Log at a moment what is logged inside the block."""
    stream.set_time(TIMELINE, duration=nanoseconds([seconds])[0])
    try:
        yield
    finally:
        stream.reset_time()
