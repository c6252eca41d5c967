"""What a rater sees of a session, in which order, and what they say of it."""

from __future__ import annotations

import json
import zlib
from collections.abc import Iterator
from dataclasses import dataclass
from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from nao_sim.game.errors import GameError
from nao_sim.game.session import Cut
from nao_sim.game.store.folder import SessionFolder
from nao_sim.game.tables import Rating, Session, Turn
from nao_sim.game.tables.scores import AUTO
from nao_sim.game.watch.cuts import open_cut
from nao_sim.people.filming.avi_writer import AviWriter


@dataclass(frozen=True)
class Item:
    """One turn to be rated.

    Attributes:
        turn: the turn.
        cuts: the films of its answers, one an attempt; empty: nothing was filmed.
        position: the how-manieth it is shown, from 1.
    """

    turn: Turn
    cuts: tuple[Cut, ...]
    position: int


@dataclass(frozen=True)
class Sitting:
    """A rater before a session.

    Attributes:
        folder: the session's.
        session: its row.
        rater: pseudonym.
        blind: order shuffled, condition hidden.
        items: all trials, in the order in which they are shown.
        rated: keys of the turns that this rater has rated already.
    """

    folder: SessionFolder
    session: Session
    rater: str
    blind: bool
    items: tuple[Item, ...]
    rated: frozenset[str]

    @property
    def open(self) -> tuple[Item, ...]:
        """What is still to be rated."""
        return tuple(item for item in self.items if item.turn.turn_id not in self.rated)

    @property
    def keys(self) -> tuple[str, ...]:
        """The scores that may be given, as typed."""
        return tuple(self.session.scale.split("/"))

    def say(self, item: Item, score: int | None, excluded: str | None = None, note: str = "") -> None:
        """Write a rating down, on the disk before this returns.

        Args:
            item: what was rated.
            score: the score; None: no trial.
            excluded: why it is no trial.
            note: anything else.
        """
        now = datetime.now(UTC).astimezone().isoformat(timespec="milliseconds")
        row = (item.turn.turn_id, self.rater, now, score, self.session.scale, self.session.rule, self.blind)
        self.folder.rate(Rating(*row, item.position, None, excluded, note))


def sitting(path: Path, rater: str, blind: bool) -> Sitting:
    """Prepare what a rater sees: the children's turns, but those that the game itself found to be no trials.

    A blind order is shuffled by a seed that follows from session and rater, so that a sitting that was broken off
    goes on in the same order; each rating keeps its position.

    Args:
        path: the session's folder.
        rater: pseudonym.
        blind: shuffle.

    Raises:
        GameError: no session, or an impossible rater.
    """
    folder = SessionFolder(path)
    played = folder.played()
    if played.session is None:
        raise GameError(f"{path} holds no session; name the folder that nao-sim game wrote")
    if rater == AUTO or not rater.replace("-", "").replace("_", "").isalnum():
        raise GameError(f"a rater cannot be called '{rater}'; give a pseudonym such as R1")
    turns = [turn for turn in played.turns if turn.is_trial]
    if blind:
        seed = zlib.crc32(f"{played.session.session}/{rater}".encode())
        turns = [turns[k] for k in np.random.default_rng(seed).permutation(len(turns))]
    items = tuple(Item(turn, _cuts(folder, turn), k) for k, turn in enumerate(turns, 1))
    rated = frozenset(rating.turn_id for rating in folder.ratings() if rating.rater == rater)
    return Sitting(folder, played.session, rater, blind, items, rated)


def _cuts(folder: SessionFolder, turn: Turn) -> tuple[Cut, ...]:
    """Return where the films of a turn's answers are."""
    place = folder.turn_folder(turn.turn)
    films = json.loads((place / "turn.json").read_text(encoding="utf-8"))["films"]
    cuts = []
    for film in films:
        if film["answering"] and film["frames"]:
            # What the session kept itself lies in the turn's folder; one's own film is relative to the session's.
            kept = place / film["file"]
            cuts.append(Cut(kept if kept.is_file() else folder.path / film["file"], film["from_s"], film["to_s"]))
    return tuple(cuts)


def frames_of(item: Item) -> Iterator[tuple[np.ndarray, float]]:
    """Yield the BGR frames of an item's answers one after the other, each with its frame rate."""
    for cut in item.cuts:
        clip = open_cut(cut)
        for frame in clip:
            yield frame, clip.fps


def extract(item: Item, path: Path) -> bool:
    """Write an item's answers as one film of a name that tells nothing; False: nothing was filmed."""
    frames = frames_of(item)
    first = next(frames, None)
    if first is None:
        return False
    height, width = first[0].shape[:2]
    with AviWriter(path, width, height, first[1], quality=90) as writer:
        writer.write(first[0])
        for frame, _ in frames:
            if frame.shape[:2] == (height, width):
                writer.write(frame)
    return True
