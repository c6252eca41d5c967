"""The gesture-tracking environment for Gymnasium (the extra ``gymnasium``).

::

    import gymnasium
    environment = gymnasium.make("nao_sim.gym_environment:NaoTrackGesture-v0", gestures="yes")

Actions are scaled to -1 … 1 (the joint's lower … upper bound), which Gymnasium's learners expect; observations are
those of :mod:`nao_sim.environment`, as a dictionary.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import gymnasium
import numpy as np
from gymnasium import spaces
from numpy.typing import NDArray

from nao_sim.environment import track
from nao_sim.errors import NaoSimError
from nao_sim.robot import TargetError

ID = "NaoTrackGesture-v0"

# Gymnasium wants finite spaces; a robot that has been thrown about is clipped to them.
_BOUNDS = {
    "angles": (-4.0, 4.0),
    "velocities": (-50.0, 50.0),
    "reference": (-4.0, 4.0),
    "lean": (-4.0, 4.0),
    "planned_lean": (-4.0, 4.0),
    "gyro": (-50.0, 50.0),
    "feet": (0.0, 1000.0),
    "left": (0.0, 1.0),
}


class NoEpisodeError(NaoSimError, gymnasium.error.ResetNeeded):
    """A step while no episode is on."""


class NaoTrackGesture(gymnasium.Env[dict[str, NDArray[np.float64]], NDArray[np.float32]]):
    """:func:`nao_sim.environment.track` with Gymnasium's interface.

    Args:
        gestures: names or files of gestures; each episode draws one.
        render_mode: None, or ``"rgb_array"``.
        limits: the robot's limit set.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 50}  # noqa: RUF012 - Gymnasium's own interface

    def __init__(
        self, gestures: str | Sequence[str] = "bye_right", render_mode: str | None = None, limits: str = "thesis"
    ) -> None:
        if render_mode not in (None, "rgb_array"):
            raise NaoSimError(f"no render mode '{render_mode}'; leave it out, or ask for 'rgb_array'")
        self.render_mode = render_mode
        self._environment = track(gestures, limits=limits)
        self._over = "has not begun"
        bounds = self._environment.action_spec()
        self._low, self._span = bounds.minimum, bounds.maximum - bounds.minimum
        self.action_space = spaces.Box(-1.0, 1.0, bounds.shape, np.float32)
        observed = self._environment.observation_spec()
        self.observation_space = spaces.Dict(
            {name: spaces.Box(*_BOUNDS[name], spec.shape, np.float64) for name, spec in observed.items()}
        )

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[dict[str, NDArray[np.float64]], dict[str, Any]]:
        """Start an episode; a seed makes this and the following episodes' draws repeatable."""
        super().reset(seed=seed)
        if seed is not None:
            self._environment.task.seed(seed)
        moment = self._environment.reset()
        self._over = ""
        return self._plain(moment.observation), {}

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[dict[str, NDArray[np.float64]], float, bool, bool, dict[str, Any]]:
        """Send one set-point; ``terminated`` is a fall, ``truncated`` the end of the gesture.

        Raises:
            NoEpisodeError: before the first reset, or after the end of an episode.
            TargetError: not one finite number per motor. Nothing has moved then.
        """
        if self._over:
            raise NoEpisodeError(f"the episode {self._over}; call reset() before step()")
        asked = np.asarray(action, dtype=float)
        if asked.shape != self._low.shape or not np.isfinite(asked).all():
            raise TargetError(f"an action must be {self._low.size} finite numbers from -1 to 1, one per motor")
        moment = self._environment.step(self._low + self._span * (asked + 1.0) / 2.0)
        self._over = "is over" if moment.last() else ""
        fell = moment.last() and moment.discount == 0.0
        return self._plain(moment.observation), float(moment.reward), fell, moment.last() and not fell, {}

    def render(self) -> NDArray[np.uint8] | None:
        """Return the robot as a picture, if the render mode is ``"rgb_array"``."""
        if self.render_mode != "rgb_array":
            return None
        return np.asarray(self._environment.physics.render(240, 320), dtype=np.uint8)

    def close(self) -> None:
        """Free the simulation."""
        self._environment.close()

    @staticmethod
    def _plain(observation: Mapping[str, NDArray[np.float64]]) -> dict[str, NDArray[np.float64]]:
        return {name: np.clip(value, *_BOUNDS[name]) for name, value in observation.items()}


gymnasium.register(ID, entry_point="nao_sim.gym_environment:NaoTrackGesture")
