"""The session's time: seconds since its start, by the clock when a camera watches, else as played."""

from __future__ import annotations

import time


class Clock:
    """Seconds since the session's start.

    With films and actors nothing has to be waited for: time then advances by the length of what is shown, as if it
    were shown in real time.

    Args:
        now: where to begin; a resumed session goes on where it was.
        live: whether to keep step with the real clock.
    """

    def __init__(self, now: float = 0.0, live: bool = False) -> None:
        self.live = live
        self._now = now
        self._begun = time.monotonic() - now

    @property
    def now(self) -> float:
        """Seconds since the session's start."""
        return time.monotonic() - self._begun if self.live else self._now

    def spend(self, seconds: float) -> None:
        """Let time pass; in a live session, by sleeping."""
        self.until(self.now + seconds)

    def until(self, moment: float) -> None:
        """Let time pass up to a moment, if that lies ahead."""
        if self.live:
            time.sleep(max(0.0, moment - self.now))
        else:
            self._now = max(self._now, moment)
