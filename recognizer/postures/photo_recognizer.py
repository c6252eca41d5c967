"""A photo in, an answer out: the hand among everything that may be one, and its posture."""

from __future__ import annotations

import dataclasses
import os
import time
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from recognizer.errors import DatabaseError
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.learning.decision import Decision
from recognizer.postures.candidates import Candidate, candidates, check_size, close_up, is_plain
from recognizer.postures.errors import HandTooSmallError, NoHandError, NoSkinError
from recognizer.postures.hand import descriptors
from recognizer.postures.learning.methods import method_of
from recognizer.postures.person import posture_shares
from recognizer.postures.person.person_in_view import CERTAIN, SHOWN, Person, find_person, part_of_person
from recognizer.postures.photo import as_bgr, read_photo
from recognizer.postures.thesis import baseline
from recognizer.postures.types import Image
from recognizer.recognition import Recognition, Watched
from recognizer.video.frame_clock import ASSUMED_FPS

# Distances of less likely guesses count this much more, so that they win only where the likely one is poor.
SEGMENTATION_COST = {"skin": 1.0, "skin without Gray-World": 1.4, "background": 1.4, "person": 1.0}
REJECTED_COST = 1.3  # something that is a posture is rather the hand meant than something that is none
TILT_COST = 0.3  # added to 1 for a hand pointing down, where no arm leaves the picture to say so
SAME_PLACE = 0.3  # overlap of boxes from which two candidates are one object
NO_HAND = 2.5  # thresholds: an object further than this from every hand is no hand


@dataclass(frozen=True)
class Seen:
    """A candidate with what its neighbours say."""

    candidate: Candidate
    decision: Decision
    cost: float  # distance to its nearest row, with what speaks against the candidate


class PhotoRecognizer:
    """Names postures on photos by their nearest neighbours in a database.

    Args:
        database: of method "static" (ours) or "thesis_static".

    Raises:
        DatabaseError: a database of moving gestures, or of another feature version.
    """

    def __init__(self, database: Database) -> None:
        self.method = method_of(database)
        self.database = database
        self.model = self.method.model().fit(database)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> PhotoRecognizer:
        """Read a recogniser from its database file."""
        return cls(Database.load(path))

    @property
    def labels(self) -> list[str]:
        """Postures that can be the answer."""
        return sorted(set(self.database.labels[self.database.labels != IRRELEVANT].tolist()))

    def recognize(
        self, photo: Image | str | os.PathLike[str], among: Iterable[str] | None = None, source: str = "photo"
    ) -> Recognition:
        """Name the posture of the best hand on a photo.

        Args:
            photo: a path, or a picture as `recognizer.postures.photo.as_bgr` takes it.
            among: labels that the context allows; all when None.
            source: name of a photo given as an array.

        Raises:
            PhotoError: unreadable, without skin, or without anything like a hand.
            DatabaseError: ``among`` names an unknown posture.
        """
        begun = time.perf_counter()
        if isinstance(photo, np.ndarray):
            image = as_bgr(photo, source)
        else:
            image, source = read_photo(photo), str(photo)
        read = time.perf_counter()
        decision, warnings = self.decide(image, self._allowed(among))
        timings = {"frames": read - begun, "recognition": time.perf_counter() - read}
        return Recognition.of(
            decision,
            amplitude=None,
            start=0.0,
            end=0.0,
            watched=Watched(1, 1 / ASSUMED_FPS),
            method=self.method.name,
            source=source,
            warnings=warnings,
            timings=timings,
        )

    def decide(self, image: Image, among: set[str] | None = None) -> tuple[Decision, tuple[str, ...]]:
        """Return what the neighbours say of the best hand, and warnings."""
        if self.method.name == baseline.METHOD:
            return self.model.decide(baseline.vector(image), among), ()
        person = self.person_in(image)
        if person is None:
            try:
                seen = self.look(image, among)
            except HandTooSmallError as error:
                return self._not_seen(str(error)), ()
        else:
            decision = self._decide_person(image, person, among)
            seen = [] if decision.label is not None else self._without_person(image, person, decision, among)
            if not seen:
                several = (f"{person.persons} persons in view; the answer is for the clearest hand",)
                return decision, several if person.persons > 1 else ()
        best = seen[0]
        if best.decision.distance > NO_HAND * self.model.threshold_:
            raise NoHandError(
                f"nothing in the photo is shaped like a hand (distance {best.decision.distance:.3g} from any known, "
                f"limit {NO_HAND * self.model.threshold_:.3g}); show the whole hand before a plain background"
            )
        small = not best.candidate.fills()
        if small and (not is_plain(image) or part_of_person(image, best.candidate.length)):
            reason = f"something like {best.decision.nearest}, but small in the picture; come closer"
            return dataclasses.replace(best.decision, label=None, rejected=True, reason=reason), ()
        return best.decision, _warnings(seen)

    def person_in(self, image: Image) -> Person | None:
        """Return the person in view; None in a close-up, and where the network does not know the database's postures.

        In the latter case hands of a person are divided from their surroundings, as those of close-ups are.
        """
        return find_person(image) if set(self.labels) <= posture_shares.known_labels() else None

    def _decide_person(self, image: Image, person: Person, among: set[str] | None) -> Decision:
        """Name the clearest hand of a person in view, or say why not."""
        if not person.spots:
            try:
                check_size(person)
            except HandTooSmallError as error:
                return self._not_seen(str(error))
            return self._not_seen(posture_shares.NOT_SHOWN)
        among = set(self.labels) if among is None else among
        return posture_shares.decide(posture_shares.look_at(image, person.spots[:SHOWN])[0], among)

    def _without_person(self, image: Image, person: Person, decision: Decision, among: set[str] | None) -> list[Seen]:
        """What a close-up would show where the person is in doubt and shows no posture: it may be none.

        An object has to fill the picture, unless nothing else is there.
        """
        if person.score >= CERTAIN:
            return []
        alone = posture_shares.no_hand(decision) and is_plain(image)
        try:
            seen = self._seen([c for c in close_up(image) if alone or c.fills()], among, in_doubt=True)
        except NoSkinError:
            return []
        return seen if seen and not seen[0].decision.rejected else []

    def _not_seen(self, reason: str) -> Decision:
        return Decision(None, IRRELEVANT, IRRELEVANT, True, reason, float("inf"), self.model.threshold_, {}, ())

    def look(self, image: Image, among: set[str] | None = None) -> list[Seen]:
        """Return all candidates of a photo, the best hand first."""
        return self._seen(candidates(image), among)

    def _seen(self, found: list[Candidate], among: set[str] | None, in_doubt: bool = False) -> list[Seen]:
        seen = []
        for candidate in found:
            decision = self.model.decide(descriptors.describe(candidate.mask, candidate.frame), among)
            if decision.label is not None:
                doubt = in_doubt or not candidate.fills()
                reason = posture_shares.contradiction(candidate.image, candidate.frame, decision.label, doubt)
                if reason:
                    decision = dataclasses.replace(decision, label=None, rejected=True, reason=reason)
            nearest = decision.neighbours[0].distance
            tilt = TILT_COST * (1 - np.cos(candidate.frame.up_rad)) / 2
            cost = nearest * SEGMENTATION_COST[candidate.segmentation] * (1 + tilt)
            seen.append(Seen(candidate, decision, float(cost * (REJECTED_COST if decision.rejected else 1.0))))
        seen.sort(key=lambda s: s.cost)
        return _posture_first(seen) if seen else []

    def _allowed(self, among: Iterable[str] | None) -> set[str] | None:
        if among is None:
            return None
        names = set(among)
        unknown = sorted(names - set(self.labels))
        if unknown or not names:
            raise DatabaseError(
                f"unknown posture {', '.join(unknown) or '(none given)'}; known: {', '.join(self.labels)}"
            )
        return names


def _posture_first(seen: list[Seen]) -> list[Seen]:
    """Put the best posture first where the nearest object is none: a face or an arm beside the hand is not meant."""
    first = seen[0]
    if not first.decision.rejected:
        return seen
    elsewhere = [s for s in seen if not s.decision.rejected and _overlap(s, first) < SAME_PLACE]
    return [elsewhere[0], *(s for s in seen if s is not elsewhere[0])] if elsewhere else seen


def _overlap(a: Seen, b: Seen) -> float:
    """Return intersection over union of two candidates' boxes."""
    (ax, ay, aw, ah), (bx, by, bw, bh) = a.candidate.box, b.candidate.box
    wide = max(0.0, min(ax + aw, bx + bw) - max(ax, bx))
    high = max(0.0, min(ay + ah, by + bh) - max(ay, by))
    return wide * high / max(aw * ah + bw * bh - wide * high, 1e-9)


def _warnings(seen: list[Seen]) -> tuple[str, ...]:
    """Say so when other objects of the photo are postures too: several hands or persons."""
    best = seen[0].candidate
    others = {
        s.candidate.number for s in seen if s.candidate.segmentation == best.segmentation and not s.decision.rejected
    } - {best.number}
    if not others:
        return ()
    return (f"{len(others) + 1} hands in view; the answer is for the clearest",)


def recognize_photo(
    image: Image | str | os.PathLike[str],
    database: Database | PhotoRecognizer,
    among: Iterable[str] | None = None,
    source: str = "photo",
) -> Recognition:
    """Name the posture on one photo; for many photos make one `PhotoRecognizer`.

    Args:
        image: a path, or (h, w, 3) uint8 BGR (grey and BGRA are taken too).
        database: of postures, or a recogniser made from it.
        among: labels that the context allows; all when None.
        source: name of a photo given as an array.
    """
    recognizer = database if isinstance(database, PhotoRecognizer) else PhotoRecognizer(database)
    return recognizer.recognize(image, among, source)
