"""BIDS: a session's events as ``events.tsv`` with its sidecar, in a data set that the validator accepts.

Onsets in seconds from the session's start, missing cells ``n/a``, rows by onset. Films and ELAN files have no place in
``beh/``; keep them under ``sourcedata/``.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.extents import extent
from nao_sim.game.tables import Event, Session, Tables, Turn
from nao_sim.game.tables.scores import accept, latest_ratings

BIDS_VERSION = "1.10.0"
_COLUMNS: dict[str, dict[str, Any]] = {
    "onset": {"Description": "start, from the session's start", "Units": "s"},
    "duration": {"Description": "length; 0 for a moment", "Units": "s"},
    "trial_type": {"Description": "turn, or the kind of another event"},
    "turn_id": {"Description": "key of the turn"},
    "who": {"Description": "pseudonym of who imitates, speaks or acts"},
    "model": {"Description": "turn: pseudonym of who modelled"},
    "target": {"Description": "turn: the gesture to be imitated"},
    "phase": {"Description": "turn: the session's phase"},
    "condition": {"Description": "who takes part", "Levels": {"triadic": "with the robot", "dyadic": "without"}},
    "prompt_level": {"Description": "turn: most help given, prompt: this help; 0 none to 4 full"},
    "latency": {"Description": "turn: model's end to movement's start; n/a where no movement began", "Units": "s"},
    "waited": {"Description": "turn: how long was waited for a movement that did not begin", "Units": "s"},
    "side": {"Description": "turn: the imitator's side against the model's"},
    "auto_score": {"Description": "turn: the automatic score, a proposal"},
    "score": {"Description": "turn: the score reported, a person's where one rated"},
    "score_by": {"Description": "turn: the rater's pseudonym, or auto"},
    "excluded": {"Description": "turn: why it is no trial"},
    "text": {"Description": "what was said or noted"},
}


def bids_label(name: str) -> str:
    """Return a name as a BIDS label, which holds letters and digits only.

    Raises:
        ExchangeError: nothing is left of it.
    """
    label = re.sub(r"[^A-Za-z0-9]", "", name)
    if not label:
        raise ExchangeError(f"{name!r} has no letter or digit for a BIDS label; choose another pseudonym")
    return label


def bids_files(tables: Tables) -> dict[str, bytes]:
    """Return the files of a data set by their paths, one ``sub`` a child and one ``ses`` a session.

    Raises:
        ExchangeError: a session without a child, or two names that become one label.
    """
    files = {
        "dataset_description.json": _json(
            {"Name": "Imitation game", "BIDSVersion": BIDS_VERSION, "DatasetType": "raw", "License": "n/a"}
        ),
        "README.md": b"# Imitation game\n\nTurns, scores and other events of an imitation game's sessions, by child.\n",
    }
    labels: dict[str, str] = {}
    for session in tables.sessions:
        for child in _children(session, tables):
            subject, sitting = bids_label(child), bids_label(session.session)
            for label, name in ((f"sub-{subject}", child), (f"ses-{sitting}", session.session)):
                if labels.setdefault(label, name) != name:
                    raise ExchangeError(f"{labels[label]!r} and {name!r} both become {label}; rename one of them")
            stem = f"sub-{subject}/ses-{sitting}/beh/sub-{subject}_ses-{sitting}_task-imitation_events"
            files[f"{stem}.tsv"] = _table(_rows(session, tables))
            files[f"{stem}.json"] = _json({k: v for k, v in _COLUMNS.items() if k not in ("onset", "duration")})
    subjects = sorted(label for label in labels if label.startswith("sub-"))
    files["participants.tsv"] = (
        "participant_id\tpseudonym\n" + "".join(f"{s}\t{_cell(labels[s])}\n" for s in subjects)
    ).encode()
    files["participants.json"] = _json({"pseudonym": {"Description": "the child's pseudonym"}})
    return files


def write_bids(folder: Path, tables: Tables) -> None:
    """Write a data set into a folder that is new or empty.

    Raises:
        ExchangeError: the folder holds something, or as ``bids_files``.
    """
    if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
        raise ExchangeError(f"{folder} holds files already; name a new folder")
    for name, content in bids_files(tables).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def _children(session: Session, tables: Tables) -> list[str]:
    found = [t.imitator for t in tables.turns if t.session == session.session and t.imitator_role == "child"]
    found += [seat.partition(":")[2] for seat in session.circle if seat.startswith("child:")]
    if not found:
        raise ExchangeError(f"session {session.session} has no child; BIDS orders files by them")
    return list(dict.fromkeys(found))


def _json(values: dict[str, Any]) -> bytes:
    return json.dumps(values, indent=2, ensure_ascii=False, allow_nan=False).encode() + b"\n"


def _rows(session: Session, tables: Tables) -> list[dict[str, Any]]:
    ratings = latest_ratings(tables.ratings)
    rows = []
    for turn in tables.turns:
        span = extent(turn)
        if turn.session == session.session and span is not None:
            a = accept(turn, ratings.get(turn.turn_id, {}), session.primary_rater)
            rows.append(_turn(turn, span) | {"score": a.score, "score_by": a.by, "excluded": a.excluded})
    rows += [_event(e) | {"condition": session.condition} for e in tables.events if e.session == session.session]
    return sorted(rows, key=lambda row: row["onset"])


def _turn(turn: Turn, span: tuple[float, float]) -> dict[str, Any]:
    return {
        "onset": span[0],
        "duration": span[1] - span[0],
        "trial_type": "turn",
        "turn_id": turn.turn_id,
        "who": turn.imitator,
        "latency": turn.latency_s,
        "waited": turn.waited_s,
        **{
            key: getattr(turn, key)
            for key in ("model", "target", "phase", "condition", "prompt_level", "side", "auto_score")
        },
        "text": turn.note or None,
    }


def _event(event: Event) -> dict[str, Any]:
    return {
        "onset": event.start_s,
        "duration": 0.0 if event.end_s is None else event.end_s - event.start_s,
        "trial_type": event.kind if event.label is None else f"{event.kind} {event.label}",
        "turn_id": event.turn_id,
        "who": event.who,
        "prompt_level": event.level,
        "text": event.text or None,
    }


def _table(rows: Iterable[dict[str, Any]]) -> bytes:
    lines = ["\t".join(_COLUMNS), *("\t".join(_cell(row.get(name)) for name in _COLUMNS) for row in rows)]
    return ("\n".join(lines) + "\n").encode()


def _cell(value: Any) -> str:
    if value is None:
        return "n/a"
    if isinstance(value, float):
        return f"{value:.6f}".rstrip("0").rstrip(".")
    return " ".join(str(value).split()) or "n/a"
