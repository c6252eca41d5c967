"""A camera at its documented rate: a new picture every 1/30 s of simulated time, none in between."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from nao_sim.robot.camera import RATE_HZ
from nao_sim.robot.errors import RobotError

_ROUNDING = 1e-6
"""Share of an image's time that rounding of the clock may take."""


class Video:
    """The pictures of one camera as they become due; made by :meth:`nao_sim.robot.Nao.video`.

    Pictures fall due at whole multiples of ``1 / rate_hz``; each is taken at the end of the control period in which it
    falls due. Who asks too late misses those between, as on the robot. A reset of the robot starts the clock anew.

    Attributes:
        rate_hz: images per second of simulated time.
        image: ``(height, width, 3)`` uint8 RGB, the last picture; None before the first.
        time: simulated seconds at which it was taken.

    Example:
        >>> from nao_sim import Nao
        >>> nao = Nao()
        >>> video = nao.video("CameraTop")
        >>> video.rate_hz
        30.0
    """

    def __init__(
        self, clock: Callable[[], tuple[int, float]], take: Callable[[], np.ndarray], rate_hz: float = RATE_HZ
    ) -> None:
        """Look at a clock (resets so far, simulated seconds) and take pictures; :meth:`Nao.video` does this for you."""
        if not 0 < rate_hz <= RATE_HZ:
            raise RobotError(f"{rate_hz} images a second; the camera gives more than 0 and at most {RATE_HZ:.0f}")
        self._clock, self._take = clock, take
        self.rate_hz = float(rate_hz)
        self.image: np.ndarray | None = None
        self.time: float | None = None
        self._due: tuple[int, int] | None = None

    def read(self) -> np.ndarray | None:
        """Return the new picture, ``(height, width, 3)`` uint8 RGB, or None where none has fallen due since the last.

        Raises:
            RenderError: this machine cannot render; the message says what to install.
        """
        resets, now = self._clock()
        due = resets, int(now * self.rate_hz + _ROUNDING)
        if due == self._due:
            return None
        self.image, self.time, self._due = self._take(), now, due
        return self.image
