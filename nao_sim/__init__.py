"""nao-sim: a simulated NAO humanoid that imitates gestures seen on video."""

from typing import TYPE_CHECKING, Any

from nao_sim.rendering import choose_headless_gl

if TYPE_CHECKING:
    from nao_sim.robot import Nao

__version__ = "0.1.0"
__all__ = ["Nao", "__version__"]

choose_headless_gl()


def __getattr__(name: str) -> Any:
    """Import the robot when it is first asked for: the recogniser's commands need no MuJoCo."""
    if name == "Nao":
        from nao_sim.robot import Nao

        return Nao
    raise AttributeError(f"module 'nao_sim' has no attribute '{name}'")


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
