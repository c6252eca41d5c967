"""A robot that stands, turns its head, waves, and says how it went: ``python examples/robot.py``."""

from __future__ import annotations

import numpy as np

from nao_sim import Nao
from nao_sim.gestures import library
from nao_sim.gestures.act import act


def main() -> None:
    """Move one joint by hand, then a whole gesture."""
    with Nao() as nao:
        nao.set_angles("HeadYaw", 0.5)  # NAOqi's names, radians
        nao.step(50)  # 50 set-points of 20 ms
        print(f"head turned to {np.degrees(nao.angles[0]):.1f}°, {nao.fsr.sum():.1f} N under the feet")
        performance = act(nao, library()["bye_right"])
        log = performance.log
        print(f"waved for {log.time[-1]:.1f} s, {'fell' if log.fallen else 'stayed upright'}")


if __name__ == "__main__":
    main()
