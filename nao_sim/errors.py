"""The errors a user can meet, each a single line that names the thing and the mend.

::

    NaoSimError
    ├── ResourceError        a model or asset file is not where the package expects it
    ├── RobotError           (nao_sim.robot) unknown joint, angle out of range, unstable simulation
    ├── GestureError         (nao_sim.gestures) unknown gesture, malformed gesture file
    ├── FilmError            (nao_sim.people) a data set that cannot be made or read
    ├── EpisodeError         (nao_sim.episodes) an episode that cannot be run or written
    ├── GameError            (nao_sim.game) a session, turn table or study that cannot be played, scored or reported
    └── ExchangeError        (nao_sim.exchange) another tool's file that cannot be read or written
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class NaoSimError(Exception):
    """Base of every error that a user of ``nao_sim`` is expected to meet."""


class ResourceError(NaoSimError, FileNotFoundError):
    """A model or asset is missing from the checkout or the installed package."""


def did_you_mean(name: str, known: Iterable[str]) -> str:
    """Return ``"; did you mean 'X'?"`` for the nearest known name, else the list of known names."""
    names = list(known)
    by_fold = {n.casefold(): n for n in names}
    near = difflib.get_close_matches(name.casefold(), by_fold, n=1, cutoff=0.6)
    if near:
        return f"; did you mean '{by_fold[near[0]]}'?"
    return f"; known: {', '.join(names)}"
