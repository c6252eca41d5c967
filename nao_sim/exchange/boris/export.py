"""Sessions as the observations of a BORIS project.

A state event has no start or stop of its own: BORIS pairs events of one subject, behaviour and modifier by counting.
So both ends bear the same modifier, and every modifier is text.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from nao_sim.exchange.boris.media import MediaFacts
from nao_sim.exchange.boris.project import FORBIDDEN, VERSION, boris_faults
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.extents import apart, extent
from nao_sim.exchange.times import milliseconds
from nao_sim.game.tables import Event, Session, Tables, Turn
from nao_sim.game.tables.instants import instant
from nao_sim.game.tables.scores import latest_ratings
from nao_sim.game.tables.words import CONDITIONS, PROMPT_LEVELS, SPEECH

_STATE, _POINT = "State event", "Point event"
_COLORS = ("#1b6e4b", "#0b5f8a", "#b26a00", "#a8480f", "#5b5b5b", "#7a3e9d", "#2a7f9e", "#9a6b00", "#b03030")
_LISTED = {"speech": SPEECH, "prompt": tuple(str(level) for level in PROMPT_LEVELS if level)}
NO_TRIAL = "no trial"

_Row = tuple[float, str, str, str, str]
"""Time [s], subject, behaviour, modifier, comment."""


def plain(text: str) -> str:
    """Return a text that may be a modifier: what BORIS forbids there becomes a space."""
    return " ".join("".join(" " if c in FORBIDDEN else c for c in text).split())


def export_boris(tables: Tables, date: str, media: dict[str, tuple[Path, MediaFacts]] | None = None) -> bytes:
    """Return sessions as a BORIS project.

    Args:
        tables: any number of sessions.
        date: when it is written, ISO 8601.
        media: of sessions with a film its place and facts; the others become live observations.

    Raises:
        ExchangeError: BORIS would not read the result.
    """
    rows = {s.session: sorted(_rows(s, tables), key=lambda row: row[0]) for s in tables.sessions}
    found = [row for mine in rows.values() for row in mine]
    project = {
        "time_format": "hh:mm:ss",
        "project_date": _date(date),
        "project_name": "imitation game",
        "project_description": "Sessions of the imitation game; comments hold the turn's key.",
        "project_format_version": VERSION,
        "subjects_conf": {
            str(i): {"key": str(i + 1) if i < 9 else "", "name": name, "description": ""}
            for i, name in enumerate(dict.fromkeys(row[1] for row in found if row[1]))
        },
        "behaviors_conf": _behaviors(found, tables),
        "observations": {
            s.session: _observation(s, rows[s.session], (media or {}).get(s.session)) for s in tables.sessions
        },
        "behavioral_categories": [],
        "behavioral_categories_config": {},
        "independent_variables": _variables(tables.sessions),
        "coding_map": {},
        "behaviors_coding_map": [],
        "converters": {},
    }
    for fault in boris_faults(project):
        raise ExchangeError(f"the tables cannot become a BORIS project: {fault}")
    return json.dumps(project, indent=1, ensure_ascii=False, allow_nan=False).encode() + b"\n"


def _date(text: str) -> str:
    return instant(text).replace(tzinfo=None, microsecond=0).isoformat()


def _rows(session: Session, tables: Tables) -> Iterable[_Row]:
    turns = [t for t in tables.turns if t.session == session.session]
    ratings = latest_ratings(tables.ratings)
    for who in dict.fromkeys(t.imitator for t in turns):
        yield from _stretches("turn", [(who, extent(t), t) for t in turns if t.imitator == who])
    yield from _stretches("model", [(t.model, _pair(t.model_start_s, t.model_end_s), t) for t in turns])
    yield from _stretches("movement", [(t.imitator, _pair(t.movement_start_s, t.movement_end_s), t) for t in turns])
    for turn in turns:
        span = extent(turn)
        if span is None:
            continue
        if turn.prompt_level is not None:
            yield span[1], turn.imitator, "prompt level", str(turn.prompt_level), turn.turn_id
        for rater, r in ratings.get(turn.turn_id, {}).items():
            score = NO_TRIAL if r.score is None else str(r.score)
            yield span[1], turn.imitator, "score", f"{plain(rater)}|{score}", turn.turn_id
    for event in tables.events:
        if event.session == session.session:
            yield from _event(event)


def _pair(start: float | None, end: float | None) -> tuple[float, float] | None:
    return None if start is None or end is None else (start, end)


def _stretches(code: str, spans: list[tuple[str, tuple[float, float] | None, Turn]]) -> Iterable[_Row]:
    """Yield both ends of each stretch; those of one subject and modifier are set apart so that they pair."""
    known = sorted(((span, who, t) for who, span, t in spans if span is not None), key=lambda found: found[0])
    for key in dict.fromkeys((who, plain(t.target)) for _, who, t in known):
        mine = [(span, t) for span, who, t in known if (who, plain(t.target)) == key]
        times = apart([(milliseconds(a), milliseconds(b)) for (a, b), _ in mine])
        for (start, end), (_, turn) in zip(times, mine, strict=True):
            yield start / 1000, key[0], code, key[1], turn.turn_id
            yield end / 1000, key[0], code, key[1], turn.turn_id


def _event(event: Event) -> Iterable[_Row]:
    who, comment = event.who or "", event.text if event.turn_id is None else f"{event.turn_id} {event.text}".strip()
    if event.kind == "phase":
        name = plain(event.label or "")
        yield event.start_s, "", "phase", name, comment
        yield max(event.end_s or 0.0, event.start_s + 0.001), "", "phase", name, comment
    elif event.kind not in ("model", "movement"):
        modifier = event.label or "" if event.kind == "speech" else "" if event.level is None else str(event.level)
        yield event.start_s, who, event.kind, modifier if event.kind in _LISTED else "", comment


def _behaviors(rows: list[_Row], tables: Tables) -> dict[str, Any]:
    states = {"turn", "model", "movement", "phase"}
    raters = sorted({plain(r.rater) for r in tables.ratings})
    scores = [*sorted({level for s in tables.sessions for level in s.scale.split("/")}), NO_TRIAL]
    found = {}
    for i, code in enumerate(dict.fromkeys(row[2] for row in rows)):
        if code == "score":
            sets = [("rater", raters), ("score", scores)]
        else:
            used = list(dict.fromkeys(row[3] for row in rows if row[2] == code and row[3]))
            listed = list(_LISTED.get(code, ()))
            sets = [("what", listed + [u for u in used if u not in listed])] if used or listed else []
        found[str(i)] = {
            "type": _STATE if code in states else _POINT,
            "key": chr(ord("a") + i),
            "code": code,
            "description": "",
            "color": _COLORS[i % len(_COLORS)],
            "category": "",
            "modifiers": {str(j): {"name": n, "type": 0, "values": v} for j, (n, v) in enumerate(sets)},
            "excluded": "",
            "coding map": "",
        }
    return found


def _variables(sessions: Iterable[Session]) -> dict[str, Any]:
    return {
        "0": {
            "label": "condition",
            "description": "who takes part",
            "type": "value from set",
            "default value": "",
            "possible values": ",".join(CONDITIONS),
        }
    }


def _observation(session: Session, rows: list[_Row], media: tuple[Path, MediaFacts] | None) -> dict[str, Any]:
    events: list[list[Any]] = [[round(row[0], 3), *row[1:]] for row in rows]
    common = {
        "date": _date(session.started),
        "description": session.note,
        "time offset": 0,
        "independent_variables": {"condition": session.condition},
        "observation time interval": [0, 0],
    }
    if media is None:
        return {"type": "LIVE", **common, "file": {}, "events": events, "start_from_current_time": False}
    path, facts = media
    name = str(path.absolute())
    return {
        "type": "MEDIA",
        **common,
        "file": {str(player): [name] if player == 1 else [] for player in range(1, 9)},
        "media_info": {
            "length": {name: facts.length_s},
            "fps": {name: facts.fps},
            "hasVideo": {name: True},
            "hasAudio": {name: False},
            "offset": {"1": 0.0},
        },
        "events": [[*event, round(event[0] * facts.fps)] for event in events],
    }
