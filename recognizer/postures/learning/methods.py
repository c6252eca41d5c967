"""The two ways of describing a photo, by the name that a database carries."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from recognizer.errors import DatabaseError
from recognizer.learning.database import Database
from recognizer.learning.neighbour_classifier import NeighbourClassifier
from recognizer.postures.candidates import Candidate, close_up
from recognizer.postures.hand import descriptors
from recognizer.postures.hand.hand_frame import HandFrame
from recognizer.postures.learning.posture_model import PostureModel
from recognizer.postures.thesis import baseline
from recognizer.postures.types import Floats, Image


@dataclass(frozen=True)
class StaticMethod:
    """A feature extractor for photos with the model that reads its vectors."""

    name: str
    version: int
    names: tuple[str, ...]
    vector: Callable[[Image], Floats]  # of the likeliest hand, to learn from
    model: Callable[[], PostureModel]


def posture_vector(image: Image) -> Floats:
    """Return our vector of the likeliest hand of a close-up, (872,); databases are learnt from close-ups."""
    found: list[Candidate] = close_up(image)
    same = [c for c in found if (c.segmentation, c.number) == (found[0].segmentation, found[0].number)]
    return descriptors.describe(same[0].mask, nearest_upright([c.frame for c in same]))


def nearest_upright(frames: list[HandFrame]) -> HandFrame:
    """Return the frame nearest to upright: pictures to learn from show hands that way up."""
    return min(frames, key=lambda frame: abs(frame.up_rad))


METHODS = {
    method.name: method
    for method in (
        StaticMethod(descriptors.METHOD, descriptors.VERSION, descriptors.NAMES, posture_vector, PostureModel),
        StaticMethod(
            baseline.METHOD,
            baseline.VERSION,
            baseline.NAMES,
            baseline.vector,
            lambda: PostureModel(NeighbourClassifier(n_neighbors=1)),  # best at k = 1 (S7), features in [0, 1] (S18)
        ),
    )
}


def method_of(database: Database) -> StaticMethod:
    """Return the method that a database of photos was made with.

    Raises:
        DatabaseError: a database of moving gestures, or of another version of the features.
    """
    method = METHODS.get(database.method)
    if method is None:
        raise DatabaseError(
            f"the database is of method '{database.method}', photos need {' or '.join(METHODS)}; train one on photos"
        )
    if database.version != method.version or database.names != method.names:
        raise DatabaseError(
            f"the database has version {database.version} of the {method.name} features, "
            f"this program version {method.version}; train it again"
        )
    return method
