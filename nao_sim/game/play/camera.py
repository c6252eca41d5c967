"""Somebody before a camera: watched from the moment their turn comes until they rest again."""

from __future__ import annotations

import contextlib
import queue
import threading
import time
from collections.abc import Iterator
from dataclasses import dataclass
from types import TracebackType
from typing import TYPE_CHECKING

import cv2
import numpy as np

from nao_sim.game.errors import GameError
from nao_sim.game.session.sources import Camera
from nao_sim.game.watch.watching import Film

if TYPE_CHECKING:
    from nao_sim.game.play.people import Attempt
    from nao_sim.game.session import PlannedTurn

REST_S = 0.7
"""So long without movement ends a performance."""
LONGEST_S = 12.0
ASSUMED_FPS = 25.0
"""What a camera says of its rate is often wrong; each picture carries the time at which it came."""
_SILENT_S = 3.0
_SMALL = (80, 60)
# Mean grey levels that the fastest hundredth of the picture changes by in a step, above the camera's own noise.
_MOVES = 14.0


@dataclass(frozen=True)
class _Picture:
    at: float
    frame: np.ndarray


class CameraPlayer:
    """A camera that runs through the whole session; between turns its pictures are let go.

    Args:
        who: whom it films.
        camera: as the session file has it.
        timeout_s: how long a movement is waited for.
    """

    def __init__(self, who: str, camera: Camera, timeout_s: float) -> None:
        self._who, self._camera, self._timeout_s = who, camera, timeout_s
        self._pictures: queue.Queue[_Picture] = queue.Queue(maxsize=8)
        self._stopped = threading.Event()

    def __enter__(self) -> CameraPlayer:
        """Open the camera.

        Raises:
            GameError: no such camera, or it gives no picture.
        """
        self._capture = cv2.VideoCapture(self._camera.device)
        ok, _ = self._capture.read()
        if not ok:
            self._capture.release()
            raise GameError(
                f"participant {self._who}: camera {self._camera.device!r} gives no picture; plug it in, close other "
                "programs that use it, or check its number or address"
            )
        self._thread = threading.Thread(target=self._run, daemon=True)
        self._thread.start()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._stopped.set()
        self._thread.join(timeout=2.0)
        self._capture.release()

    def _run(self) -> None:
        """Take pictures as they come; the oldest is let go when nobody watches."""
        while not self._stopped.is_set():
            ok, frame = self._capture.read()
            if not ok:
                break
            if self._pictures.full():
                with contextlib.suppress(queue.Empty):
                    self._pictures.get_nowait()
            self._pictures.put(_Picture(time.monotonic(), frame))

    def begin(self) -> None:
        """Nothing to do: the camera sees what happens now."""

    def attempt(self, turn: PlannedTurn, number: int, answering: bool) -> Attempt | None:
        """Watch one attempt; see :class:`nao_sim.game.play.people.Player`."""
        from nao_sim.game.play.people import Attempt

        return Attempt(Film(self._frames(), ASSUMED_FPS, f"camera of {self._who}, turn {turn.number}"))

    def _frames(self) -> Iterator[tuple[float, np.ndarray]]:
        """Yield frames and their times until the person has moved and rests, or the time-out or the camera ends it."""
        while not self._pictures.empty():
            self._pictures.get_nowait()
        begun = time.monotonic()
        moved: float | None = None
        before: np.ndarray | None = None
        while True:
            try:
                picture = self._pictures.get(timeout=_SILENT_S)
            except queue.Empty:
                return
            yield picture.at - begun, picture.frame
            small = cv2.cvtColor(cv2.resize(picture.frame, _SMALL, interpolation=cv2.INTER_AREA), cv2.COLOR_BGR2GRAY)
            if before is not None and _changes(before, small):
                moved = picture.at
            before = small
            resting = moved is not None and picture.at - moved >= REST_S
            waited = picture.at - begun
            if resting or waited >= LONGEST_S + self._timeout_s or (moved is None and waited >= self._timeout_s):
                return


def _changes(before: np.ndarray, after: np.ndarray) -> bool:
    step = np.sort(cv2.absdiff(before, after), axis=None)
    return float(step[-len(step) // 100 :].mean() - np.median(step)) > _MOVES
