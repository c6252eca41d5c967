"""The ways of describing a clip, by name: what the database says is what the recogniser uses."""

from __future__ import annotations

import dataclasses
from collections.abc import Callable
from typing import Any

import numpy as np

from recognizer.errors import ClipError, DatabaseError
from recognizer.features import body_features
from recognizer.learning.body_model import BodyModel
from recognizer.learning.database import Database
from recognizer.thesis import vectors
from recognizer.thesis.classifier import ThesisModel
from recognizer.tracking import Track


@dataclasses.dataclass(frozen=True)
class Method:
    """A feature extractor with the model that reads its vectors.

    Attributes:
        name, version: what a database must agree with.
        names: (d,) names of the features.
        features: from a track to a vector (d,); a ClipError where it needs somebody and sees nobody.
        model: estimator that reads them.
        needs_body: whether the track must find the person.
        bits: in which a database stores each feature; many weak features need few.
    """

    name: str
    version: int
    names: tuple[str, ...]
    features: Callable[[Track], np.ndarray]
    model: Any
    needs_body: bool
    bits: int


def _body(track: Track) -> np.ndarray:
    if track.body is None:
        raise ClipError(f"{track.source}: {NOBODY}; film somebody from the hips up, head and arms in view")
    grey = track.samples[0].grey
    size = (grey.shape[1], grey.shape[0])
    items = body_features.describe(track.steps, track.head_motion, track.motion, list(track.regions), track.body, size)
    return body_features.vector(items)


def _thesis(track: Track) -> np.ndarray:
    return vectors.features([sample.grey for sample in track.samples], track.regions)


NOBODY = "nobody is seen in this clip"

METHODS = {
    method.name: method
    for method in (
        Method(body_features.METHOD, body_features.VERSION, body_features.names(), _body, BodyModel, True, 4),
        Method(vectors.METHOD, vectors.VERSION, vectors.NAMES, _thesis, ThesisModel, False, 16),
    )
}


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
