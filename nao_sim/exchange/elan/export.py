"""A session as an EAF; a file that people have worked on keeps everything and gets what it lacks."""

from __future__ import annotations

import uuid
from pathlib import Path
from statistics import median
from urllib.parse import quote
from xml.etree import ElementTree

from nao_sim.exchange.elan.document import Document
from nao_sim.exchange.elan.layout import ABOUT, FUNCTION, MOMENT, NO_TRIAL, STRETCH, PlannedTier, plan_tiers
from nao_sim.exchange.elan.reading import ReadTier, read_tiers
from nao_sim.exchange.elan.rules import eaf_faults
from nao_sim.exchange.elan.xml_text import new_document, to_bytes, xml_text
from nao_sim.exchange.errors import ExchangeError
from nao_sim.exchange.extents import extent
from nao_sim.game.tables import Tables
from nao_sim.game.tables.words import SPEECH

_MIME = {
    ".mp4": "video/mp4", ".mpg": "video/mpeg", ".mpeg": "video/mpeg", ".mov": "video/quicktime",
    ".avi": "video/x-msvideo", ".webm": "video/webm", ".mkv": "video/x-matroska", ".wav": "audio/x-wav",
}  # fmt: skip
_SCORES = {"0": "none, or unrelated to the target", "1": "related to the target", "2": "as the target"}


def export_eaf(
    tables: Tables,
    date: str,
    film: Path | None = None,
    beside: Path | None = None,
    base: ElementTree.Element | None = None,
) -> tuple[bytes, list[str]]:
    """Return one session as the bytes of an EAF 3.0, and notes on what could not go in.

    Args:
        tables: of one session.
        date: when it is written, ISO 8601.
        film: the session's film, to be linked.
        beside: the folder the EAF will lie in, from which the film is also linked relatively.
        base: an EAF to add to; nothing in it is changed or taken away.

    Raises:
        ExchangeError: the tables hold another number of sessions than one, or the base breaks ELAN's rules.
    """
    if len(tables.sessions) != 1:
        raise ExchangeError(
            f"an EAF holds one session, these tables hold {len(tables.sessions)}; name one session's folder"
        )
    session = tables.sessions[0]
    for fault in () if base is None else eaf_faults(base):
        raise ExchangeError(f"the EAF to add to is damaged: {fault}; mend it in ELAN or write a new file")
    document = Document(new_document(session.software or "nao-sim", date) if base is None else base)
    if film is not None:
        _link(document, film, beside, _origin_ms(tables))
    tiers, notes = plan_tiers(tables)
    known = {tier.name: tier for tier in read_tiers(document.root)}
    _types(document, session.scale)
    for tier in tiers:
        notes += _add(document, tier, known)
    document.set_property("URN", f"urn:nl-mpi-tools-elan-eaf:{uuid.uuid5(uuid.NAMESPACE_URL, session.session)}")
    document.finish()
    for fault in eaf_faults(document.root):
        raise ExchangeError(f"session {session.session} cannot become an EAF: {fault}")
    return to_bytes(document.root), notes


def _types(document: Document, scale: str) -> None:
    words = {level: _SCORES[level] for level in scale.split("/")} | {NO_TRIAL: "not a trial"}
    document.vocabulary(f"score {scale}", words)
    document.vocabulary(FUNCTION, {word: word for word in SPEECH})
    for name in (STRETCH, MOMENT):
        document.type(name, None, None)
    document.type(ABOUT, "Symbolic_Association", None)
    for name in (f"score {scale}", FUNCTION):
        document.type(name, "Symbolic_Association", name)


def _add(document: Document, planned: PlannedTier, known: dict[str, ReadTier]) -> list[str]:
    """Add what a tier lacks; return notes on what the file has no room for."""
    old = known.get(xml_text(planned.name))
    if old is not None and old.parent is not None:
        return []  # it came from there: the times are its parent's
    element = document.tier(planned.name, planned.kind, planned.participant, None, None)
    keys: dict[int, str] = {}
    notes = []
    for number, (start, end, value) in enumerate(planned.stretches):
        there = _overlapping(old, start, end)
        if there is None:
            keys[number] = document.aligned(element, start, end, value)
        elif there:
            keys[number] = there
        else:
            notes.append(f"{planned.name} at {start / 1000:.3f} s: the file has something else there, left as it is")
    for name, kind, annotator, values in planned.below:
        filled = {a.parent for a in known[xml_text(name)].annotations} if xml_text(name) in known else set()
        child = document.tier(name, kind, planned.participant, annotator, planned.name)
        for number, value in values.items():
            if number in keys and keys[number] not in filled:
                document.referring(child, keys[number], value, document.entry(kind, value))
    return notes


def _overlapping(old: ReadTier | None, start_ms: int, end_ms: int) -> str | None:
    """Return the key of the one annotation that lies in the same place by more than half; "" where it is another."""
    found = []
    for a in old.annotations if old is not None else ():
        if a.start_s is not None and a.end_s is not None:
            shared = min(end_ms, a.end_s * 1000) - max(start_ms, a.start_s * 1000)
            if shared > 0.5:
                longer = max(end_ms - start_ms, 1000 * (a.end_s - a.start_s))
                found.append((2 * shared > longer, a.key))
    if not found:
        return None
    return found[0][1] if len(found) == 1 and found[0][0] else ""


def _link(document: Document, film: Path, beside: Path | None, origin_ms: int) -> None:
    import os

    relative = Path(os.path.relpath(film, beside)).as_posix() if beside is not None else film.name
    mime = _MIME.get(film.suffix.lower(), "unknown")
    document.media(film.absolute().as_uri(), quote(f"./{relative}", safe="/."), mime, origin_ms)


def _origin_ms(tables: Tables) -> int:
    """Return where in the film the session's time 0 lies; 0 where the turns do not agree on it."""
    session = tables.sessions[0]
    offsets = []
    for turn in tables.turns:
        span = extent(turn)
        if span is not None and turn.film_s is not None and turn.film in (None, session.film):
            offsets.append(turn.film_s - span[0])
    if not offsets or max(offsets) - min(offsets) > 0.1:
        return 0
    return round(1000 * median(offsets))
