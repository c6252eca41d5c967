"""Events coded in BORIS into the tables: scores as ratings, the rest as events; nothing is taken away."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import Any

from nao_sim.exchange.boris.export import NO_TRIAL, export_boris, plain
from nao_sim.exchange.boris.project import parse_boris
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.merged import Merged
from nao_sim.game.tables import Event, Rating, Session, Tables
from nao_sim.game.tables.scores import latest_ratings
from nao_sim.game.tables.words import EVENT_KINDS, SPEECH

_SAME_S = 0.0015
"""BORIS moves the ends of states by a millisecond."""


@dataclass(frozen=True)
class _Coded:
    """One coded event, a state with both ends."""

    start_s: float
    end_s: float | None
    subject: str
    code: str
    modifier: str
    comment: str


def merge_boris(tables: Tables, project: dict[str, Any], when: str) -> Merged:
    """Merge a project's observations into the sessions of their names.

    Args:
        tables: any number of sessions.
        project: a project, as ``parse_boris`` returns it.
        when: when it is merged, ISO 8601 with a zone; new ratings bear it.

    Raises:
        ExchangeError: no observation is named as a session, or an event is malformed.
    """
    names = {s.session: s for s in tables.sessions}
    common = [name for name in project["observations"] if name in names]
    if not common:
        have = ", ".join(project["observations"]) or "none"
        raise ExchangeError(f"no observation is named as a session ({', '.join(names)}); the project has: {have}")
    ours = parse_boris("our own export", export_boris(tables, when))
    states = {b["code"] for b in project.get("behaviors_conf", {}).values() if b.get("type", "").startswith("State")}
    ratings, events = list(tables.ratings), list(tables.events)
    news: list[str] = []
    strangers = [name for name in project["observations"] if name not in names]
    notes = [f"left out, no sessions here: {', '.join(strangers)}"] if strangers else []
    for name in common:
        theirs = _coded(name, project["observations"][name].get("events", []), states, notes)
        known = _coded(name, ours["observations"][name]["events"], {"turn", "model", "movement", "phase"}, [])
        for coded in _without(theirs, known):
            rating = _rating(coded, names[name], tables, when) if coded.code == "score" else None
            if rating is not None:
                latest = latest_ratings(ratings).get(rating.turn_id, {}).get(rating.rater)
                if latest is None or latest.score != rating.score:
                    ratings.append(rating)
                    news.append(f"{rating.rater} scored {rating.turn_id}: {coded.modifier.rpartition('|')[2]}")
                continue
            event = _event(coded, name, tables)
            if event not in events:
                events.append(event)
                news.append(f"{name}: {coded.code} {coded.modifier} at {coded.start_s:.3f} s")
        missing = len(list(_without(known, theirs)))
        if missing:
            notes.append(f"{name}: {missing} of our events are not in the project; kept")
    return Merged(replace(tables, ratings=tuple(ratings), events=tuple(events)), tuple(news), tuple(notes))


def _coded(name: str, events: Sequence[Any], states: set[str], notes: list[str]) -> list[_Coded]:
    """Return coded events; states are paired by counting, one left over becomes a moment and is noted."""
    found: list[_Coded] = []
    begun: dict[tuple[str, str, str], tuple[float, str]] = {}
    for event in sorted(_checked(name, events), key=lambda e: e[0]):
        time, key, comment = event[0], (event[1], event[2], event[3]), event[4]
        if key[1] not in states:
            found.append(_Coded(time, None, key[0], key[1], key[2], comment))
        elif key in begun:
            start, first = begun.pop(key)
            found.append(_Coded(start, time, key[0], key[1], key[2], first or comment))
        else:
            begun[key] = (time, comment)
    for key, (time, comment) in begun.items():
        notes.append(f"{name}: {key[1]} of {key[0] or 'nobody'} at {time:.3f} s has no end; taken as a moment")
        found.append(_Coded(time, None, key[0], key[1], key[2], comment))
    return sorted(found, key=lambda c: c.start_s)


def _checked(name: str, events: Sequence[Any]) -> Iterator[tuple[float, str, str, str, str]]:
    for event in events:
        try:
            time, subject, code, modifier, comment = event[:5]
            time = float(time)
            if not (time == time and abs(time) < 1e9 and isinstance(code, str)):
                raise ValueError
        except (TypeError, ValueError, KeyError):
            raise ExchangeError(
                f"observation {name!r}: {event!r} is no event (time, subject, code, modifier, comment)"
            ) from None
        yield time, str(subject or ""), code, "" if modifier is None else str(modifier), str(comment or "")


def _without(events: Sequence[_Coded], known: Sequence[_Coded]) -> Iterator[_Coded]:
    """Yield the events that are not among the known ones."""
    left = list(known)
    for event in events:
        match = next((k for k in left if _alike(event, k)), None)
        if match is None:
            yield event
        else:
            left.remove(match)


def _alike(a: _Coded, b: _Coded) -> bool:
    near = abs(a.start_s - b.start_s) <= _SAME_S and abs((a.end_s or 0) - (b.end_s or 0)) <= _SAME_S
    return near and (a.subject, a.code, a.modifier, a.comment) == (b.subject, b.code, b.modifier, b.comment)


def _rating(coded: _Coded, session: Session, tables: Tables, when: str) -> Rating | None:
    """Return a coded score as a rating; None where turn or score cannot be told."""
    rater, bar, value = coded.modifier.partition("|")
    turn = coded.comment.split(" ")[0]
    known = {t.turn_id for t in tables.turns if t.session == session.session}
    if not bar or not rater or rater == "None" or turn not in known:
        return None
    if value != NO_TRIAL and value not in session.scale.split("/"):
        return None
    score = None if value == NO_TRIAL else int(value)
    excluded = "other" if score is None else None
    names = {plain(r.rater): r.rater for r in tables.ratings}
    rater = names.get(rater, rater)
    return Rating(turn, rater, when, score, session.scale, session.rule, excluded=excluded, note="scored in BORIS")


def _event(coded: _Coded, name: str, tables: Tables) -> Event:
    turns = {t.turn_id for t in tables.turns}
    first, _, rest = coded.comment.partition(" ")
    turn = first if first in turns else None
    kind = coded.code if coded.code in EVENT_KINDS else "mark"
    words = rest if turn is not None else coded.comment
    label, level, text = None, None, words
    if kind == "speech":
        label = coded.modifier if coded.modifier in SPEECH else None
    elif kind == "phase":
        label = coded.modifier
    elif kind == "prompt":
        level = int(coded.modifier) if coded.modifier in ("1", "2", "3", "4") else None
    elif coded.modifier or kind == "mark":
        text = " ".join(part for part in (coded.code if kind == "mark" else "", coded.modifier, words) if part)
    return Event(name, kind, coded.start_s, coded.end_s, coded.subject or None, turn, label, level, text, "BORIS", None)
