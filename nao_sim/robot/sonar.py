"""The two sonars of the chest: a cone of rays each, the nearest echo counts."""

from __future__ import annotations

import tomllib
from functools import lru_cache

import mujoco
import numpy as np

from nao_sim.resources import resource
from nao_sim.robot.rays import cast
from nao_sim.robot.wiring import Wiring


@lru_cache
def _specification() -> tuple[float, float, float]:
    """Return least and greatest range in m and the full cone angle in rad."""
    data = tomllib.loads(resource("assets", "nao", "sensors.toml").read_text("utf-8"))["sonar"]
    return data["range_m"][0], data["range_m"][1], float(np.radians(data["cone_deg"]))


def _cone(angle: float) -> np.ndarray:
    """Return ``(25, 3)`` unit vectors about +z: the middle, and rings at a third, two thirds and all of the cone."""
    rays = [(0.0, 0.0, 1.0)]
    for ring in (1, 2, 3):
        tilt = angle / 2 * ring / 3
        for turn in np.arange(8) * np.pi / 4 + ring * np.pi / 8:
            rays.append((np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)))
    return np.array(rays)


class Sonar:
    """Casts the rays of both emitters into what is not the robot itself."""

    def __init__(self, wiring: Wiring) -> None:
        self._model, self._own = wiring.model, wiring.geoms
        self._sites = {side: wiring.site(f"{side[0]}SonarEmitter") for side in ("Left", "Right")}
        self._least, self._greatest, angle = _specification()
        self._rays = _cone(angle)

    def read(self, data: mujoco.MjData) -> dict[str, float]:
        """Return the distance in m to the nearest echo of each side, within the sensor's range."""
        return {side: self._distance(data, site) for side, site in self._sites.items()}

    def _distance(self, data: mujoco.MjData, site: int) -> float:
        rays = self._rays @ data.site_xmat[site].reshape(3, 3).T
        nearest = cast(self._model, data, self._own, data.site_xpos[site], rays, self._greatest).min()
        return float(np.clip(nearest, self._least, self._greatest))
