"""The error of exchange."""

from nao_sim.errors import NaoSimError


class ExchangeError(NaoSimError):
    """Another tool's file that cannot be read, merged or written."""
