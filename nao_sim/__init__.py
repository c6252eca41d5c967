"""nao-sim: a simulated NAO humanoid that imitates gestures seen on video."""

from nao_sim.rendering import choose_headless_gl

__version__ = "0.1.0"

choose_headless_gl()
