"""nao-sim: a simulated NAO humanoid that imitates gestures seen on video."""

__version__ = "0.1.0"
