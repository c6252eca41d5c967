"""The recordings of episodes and sessions that a reviewer wants to see."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

from nao_sim.errors import did_you_mean
from nao_sim.game.errors import GameError
from nao_sim.game.store.folder import SessionFolder
from nao_sim.game.store.lanes import log_rating_lane, log_states
from nao_sim.game.store.layout import session_layout
from nao_sim.game.store.recording import recording_id
from nao_sim.game.tables import Event, Rating, Session, Turn
from nao_sim.game.tables.scores import latest_ratings
from nao_sim.recording.stream import recording

EPISODE = "episode.rrd"


def recordings(paths: Iterable[Path], work: Path) -> list[Path]:
    """Return the files that show episodes and sessions.

    Args:
        paths: folders of episodes or sessions, folders that hold such folders, or ``.rrd`` files.
        work: an empty folder for what people have scored, which the recordings do not know.

    Raises:
        GameError: nothing to see at a path.
    """
    found: list[Path] = []
    for path in paths:
        shown = _of(path, work)
        if not shown:
            beside = [p.name for p in path.parent.glob("*")] if path.parent.is_dir() else []
            hint = did_you_mean(path.name, beside) if beside and not path.exists() else ""
            raise GameError(
                f"{path} is no episode and no session{hint}; name a folder that nao-sim imitate or game wrote"
            )
        found += shown
    return list(dict.fromkeys(found))


def _of(path: Path, work: Path) -> list[Path]:
    if path.is_file():
        return [path] if path.suffix == ".rrd" else []
    if (path / EPISODE).is_file():
        return [path / EPISODE]
    if SessionFolder(path).begun:
        return [*_pieces(path), *_scored(path, work)]
    return [file for below in sorted(path.glob("*/")) for file in _of(below, work)] if path.is_dir() else []


def _pieces(path: Path) -> list[Path]:
    """Return the pieces of a session: what stands still, the phases, the finished turns."""
    finished = [SessionFolder(path).turn_folder(turn.turn) / "turn.rrd" for turn in SessionFolder(path).played().turns]
    pieces = [path / "start.rrd", path / "phases" / "orientation.rrd", *finished, path / "phases" / "closing.rrd"]
    return [piece for piece in pieces if piece.is_file()]


def _scored(path: Path, work: Path) -> list[Path]:
    """Write what people have scored as a lane a rater, on the session's time line."""
    folder = SessionFolder(path)
    played, ratings = folder.played(), folder.ratings()
    if played.session is None or not ratings:
        return []
    file = work / f"{played.session.session}-{len(list(work.iterdir()))}.rrd"
    _write_scores(file, played.session, played.turns, ratings, _spans(played.events))
    return [file]


def _write_scores(
    file: Path,
    session: Session,
    turns: list[Turn],
    ratings: tuple[Rating, ...],
    spans: Mapping[str, tuple[float, float]],
) -> None:
    latest = latest_ratings(ratings)
    identity = recording_id(session.session, session.started)
    raters = sorted({rating.rater for rating in ratings})
    robot = any(seat.startswith("robot:") for seat in session.circle)
    with recording(file, session.session, identity, session_layout(robot)) as stream:
        for number, rater in enumerate(raters, 6):
            lane = f"{number}_scored_by_{rater}"
            log_rating_lane(stream, lane)
            states = []
            for turn in turns:
                rating = latest.get(turn.turn_id, {}).get(rater)
                if rating is not None and turn.turn_id in spans:
                    start, end = spans[turn.turn_id]
                    score = "excluded" if rating.score is None else f"score {rating.score}"
                    states += [(lane, start, score), (lane, end, "end")]
            log_states(stream, states)


def _spans(events: Iterable[Event]) -> dict[str, tuple[float, float]]:
    """When each turn began, and when the next one did or the last one's last event ended, seconds of the session."""
    starts: dict[str, float] = {}
    last = 0.0
    for event in events:
        if event.turn_id is not None:
            starts[event.turn_id] = min(event.start_s, starts.get(event.turn_id, event.start_s))
            last = max(last, event.end_s or event.start_s)
    order = sorted(starts, key=lambda turn: starts[turn])
    ends = [starts[turn] for turn in order[1:]] + [last]
    return {turn: (starts[turn], end) for turn, end in zip(order, ends, strict=True)}
