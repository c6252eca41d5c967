"""A turn into its folder, complete or not at all, and then into the journal."""

from __future__ import annotations

import json
import os
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from nao_sim.episodes.folder import complete_folder
from nao_sim.episodes.table import write_table
from nao_sim.game.session import PlannedTurn, SessionFile
from nao_sim.game.store.folder import SessionFolder
from nao_sim.game.store.recording import record_piece, record_start, recording_id
from nao_sim.game.store.turn_record import Done, Shown, TurnRecord
from nao_sim.game.tables import Session, Turn
from nao_sim.people.filming.avi_writer import AviWriter
from nao_sim.robot import ACTUATED, Nao

START, PIECE, SUMMARY, MOTION = "start.rrd", "turn.rrd", "turn.json", "robot.parquet"
PHASES = "phases"


def keep_start(folder: SessionFolder, row: Session, nao: Nao | None) -> None:
    """Write what stands still in the session's recording, unless it is there."""
    path = folder.path / START
    if not path.exists():
        part = path.with_name(f".{START}.part")
        record_start(part, row.session, _identity(row), nao)
        os.replace(part, path)


def keep_phase(folder: SessionFolder, name: str, row: Session, nao: Nao | None, record: TurnRecord) -> None:
    """Write the recording of a phase around the game."""
    (folder.path / PHASES).mkdir(exist_ok=True)
    path = folder.path / PHASES / f"{name}.rrd"
    part = path.with_name(f".{name}.part")
    record_piece(part, row.session, _identity(row), nao, record, None)
    os.replace(part, path)


def keep_turn(
    folder: SessionFolder,
    session: SessionFile,
    row: Session,
    turn: PlannedTurn,
    nao: Nao | None,
    record: TurnRecord,
    now: float,
) -> Turn:
    """Write a turn: its folder first, then its line in the journal, from where on it counts.

    Returns:
        The turn's row.
    """
    target = folder.turn_folder(turn.number)
    record.states += _last_states(record, now)
    made = _row(folder, session, turn, record)
    with complete_folder(target, SUMMARY) as work:
        films = [_film(work, folder.path, shown) for shown in record.films]
        record_piece(work / PIECE, row.session, _identity(row), nao, record, made)
        for number, done in enumerate(record.motions):
            _motion(work, number, done)
        seen = [
            None if s.watched.recognition is None else _plain(s.watched.recognition.to_dict()) for s in record.films
        ]
        summary = {"turn": asdict(made), "films": films, "seen": seen}
        (work / SUMMARY).write_text(json.dumps(summary, indent=1, ensure_ascii=False, allow_nan=False) + "\n", "utf-8")
    folder.turn_over(made, record.log.events, now)
    return made


def _identity(row: Session) -> str:
    return recording_id(row.session, row.started)


def _last_states(record: TurnRecord, now: float) -> list[tuple[str, float, str]]:
    """Close the lanes of a turn; one that is no trial is marked as such from its first moment."""
    ends = [(lane, now, "end") for lane in ("3_doing", "4_help", "5_proposed")]
    return [("5_proposed", record.begun_s, "excluded"), *ends] if record.excluded else ends


def _row(folder: SessionFolder, session: SessionFile, turn: PlannedTurn, record: TurnRecord) -> Turn:
    cells = dict(record.row)
    if record.excluded:
        cells |= {"auto_score": None, "auto_rule": None, "auto_scale": None}
    target = cells.pop("target", None) or turn.target or "unknown"
    answer = next((shown for shown in reversed(record.films) if shown.answering), None)
    shown = answer or (record.films[-1] if record.films else None)
    if shown is not None:
        cells |= _where(folder, turn.number, shown)
    known: dict[str, Any] = {k: round(v, 4) if isinstance(v, float) else v for k, v in cells.items()}
    return Turn(
        turn_id=f"{session.name}/{turn.number}",
        session=session.name,
        turn=turn.number,
        phase=turn.phase,
        condition=session.condition,
        design=session.design,
        model=turn.model,
        model_role=session.participant(turn.model).role,
        imitator=turn.imitator,
        imitator_role=session.participant(turn.imitator).role,
        target=target,
        episode=_relative(folder.turn_folder(turn.number), folder.path),
        **known,
    )


def _where(folder: SessionFolder, number: int, shown: Shown) -> dict[str, Any]:
    """The columns that say where a film is."""
    if shown.cut is None:
        return {"clip": _relative(folder.turn_folder(number) / _name(shown), folder.path)}
    path = _relative(shown.cut.film, folder.path)
    if shown.cut.from_s is None and shown.cut.to_s is None:
        return {"clip": path}
    return {"film": path, "film_s": shown.cut.from_s or 0.0}


def _name(shown: Shown) -> str:
    return f"{'answer' if shown.answering else 'model'}_{shown.attempt + 1}.avi"


def _relative(path: Path, folder: Path) -> str:
    return Path(os.path.relpath(path.absolute(), folder.absolute())).as_posix()


def _film(work: Path, root: Path, shown: Shown) -> dict[str, Any]:
    """Keep a film that is nowhere else; returns where it is."""
    about: dict[str, Any] = {
        "who": shown.who, "start_s": round(shown.start_s, 4), "answering": shown.answering, "attempt": shown.attempt,
        "fps": round(shown.watched.measured_fps, 3), "frames": len(shown.watched.pictures),
    }  # fmt: skip
    if shown.cut is not None:
        return about | {
            "file": _relative(shown.cut.film, root), "from_s": shown.cut.from_s, "to_s": shown.cut.to_s,
        }  # fmt: skip
    if shown.watched.pictures:
        _write_avi(work / _name(shown), shown)
    return about | {"file": _name(shown), "from_s": None, "to_s": None}


def _write_avi(path: Path, shown: Shown) -> None:
    width, height = shown.watched.size
    with AviWriter(path, width, height, shown.watched.measured_fps, quality=85) as writer:
        for jpeg in shown.watched.pictures:
            writer.write_jpeg(jpeg)


def _motion(work: Path, number: int, done: Done) -> None:
    metadata = {"start_s": f"{done.start_s:.4f}"}
    write_table(work / (MOTION if number == 0 else f"robot_{number + 1}.parquet"), done.log, ACTUATED, metadata)


def _plain(value: Any) -> Any:
    """Return a value that JSON can hold: numpy's numbers as Python's, what is not finite as null."""
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if isinstance(value, np.generic):
        value = value.item()
    return None if isinstance(value, float) and not np.isfinite(value) else value
