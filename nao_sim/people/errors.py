"""The error of films and data sets."""

from __future__ import annotations

from nao_sim.errors import NaoSimError


class FilmError(NaoSimError):
    """A data set that cannot be made or read; the message names the file and the mend."""
