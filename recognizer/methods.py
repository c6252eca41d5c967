"""The ways of describing a clip, by name: what the database says is what the recogniser uses."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from recognizer import thesis
from recognizer.database import Database
from recognizer.errors import DatabaseError
from recognizer.track import Track


@dataclasses.dataclass(frozen=True)
class Method:
    """A feature extractor with the model that reads its vectors."""

    name: str
    version: int
    names: tuple[str, ...]
    features: Callable[[Track], np.ndarray]
    model: Any


METHODS = {thesis.METHOD: Method(thesis.METHOD, thesis.VERSION, thesis.NAMES, thesis.features, thesis.ThesisModel)}


def method_of(database: Database) -> Method:
    """Return the method a database was made with.

    Raises:
        DatabaseError: an unknown method, or another version of it.
    """
    method = METHODS.get(database.method)
    if method is None:
        raise DatabaseError(
            f"the database is of method '{database.method}'; known: {', '.join(METHODS)}; train it again"
        )
    if database.version != method.version or database.names != method.names:
        raise DatabaseError(
            f"the database has version {database.version} of the {method.name} features, "
            f"this program version {method.version}; train it again"
        )
    return method
