"""The ``nao-sim`` command: one module a command, imported only when it is called."""

from nao_sim.cli.app import main

__all__ = ["main"]
