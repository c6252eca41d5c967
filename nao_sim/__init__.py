"""nao-sim: a simulated NAO humanoid that imitates gestures seen on video."""

from typing import Any

from nao_sim.rendering import choose_headless_gl

__version__ = "0.1.0"

choose_headless_gl()


def __getattr__(name: str) -> Any:
    """Import the robot when it is first asked for: the recogniser's commands need no MuJoCo."""
    if name == "Nao":
        from nao_sim.robot import Nao

        return Nao
    raise AttributeError(f"module 'nao_sim' has no attribute '{name}'")
