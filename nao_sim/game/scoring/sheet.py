"""Ratings without a keyboard at hand: a folder of clips with a sheet to fill in, and the filled sheet read back."""

from __future__ import annotations

import csv
import io
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from nao_sim.episodes.folder import complete_folder
from nao_sim.game.errors import GameError
from nao_sim.game.scoring.sitting import Item, Sitting, extract
from nao_sim.game.tables.words import EXCLUSIONS

SHEET = "sheet.csv"
COLUMNS = ("clip", "asked", "score", "excluded", "note")


def write_sheet(sitting: Sitting, folder: Path, progress: Callable[[int, int], None] | None = None) -> int:
    """Write clips ``clip_01.avi`` … in the sitting's order and ``sheet.csv`` with a line for each.

    Args:
        sitting: the rater's.
        folder: made, or replaced if it holds an older sheet.
        progress: called with clips done and clips in all.

    Returns:
        How many clips.
    """
    lines = [",".join(COLUMNS)]
    with complete_folder(folder, SHEET) as work:
        for done, item in enumerate(sitting.items, 1):
            shown = extract(item, work / f"{_clip(item)}.avi")
            lines.append(f"{_clip(item)},{item.turn.target},,,{'' if shown else 'nobody moved; nothing was filmed'}")
            if progress is not None:
                progress(done, len(sitting.items))
        (work / SHEET).write_text("\n".join(lines) + "\n", encoding="utf-8")
    return len(sitting.items)


def _clip(item: Item) -> str:
    return f"clip_{item.position:02d}"


@dataclass(frozen=True)
class _Line:
    item: Item
    score: int | None
    excluded: str | None
    note: str


def read_sheet(sitting: Sitting, path: Path) -> int:
    """Take the ratings of a filled sheet, all of them or none; lines without score and reason are left open.

    Args:
        sitting: the rater's, blind if the clips were.
        path: CSV with a column ``clip`` (of :func:`write_sheet`), ``turn_id`` or ``turn``, and a column ``score``;
            perhaps ``excluded`` and ``note``. Commas, semicolons or tabs.

    Returns:
        How many turns were rated.

    Raises:
        GameError: naming the line and the mend.
    """
    lines = [line for line in _lines(sitting, path) if line is not None]
    for line in lines:
        sitting.say(line.item, line.score, line.excluded, line.note)
    return len(lines)


def _lines(sitting: Sitting, path: Path) -> list[_Line | None]:
    try:
        text = path.read_bytes().decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise GameError(f"{path} is not UTF-8 (byte {error.start}); save it as CSV UTF-8") from None
    head = text.splitlines()[0] if text else ""
    rows = csv.DictReader(io.StringIO(text), delimiter=max(",;\t", key=head.count))
    names = list(rows.fieldnames or [])
    key = next((name for name in ("clip", "turn_id", "turn") if name in names), None)
    if key is None or "score" not in names:
        raise GameError(
            f"{path} has the columns {', '.join(names) or 'none'}; it needs score, and clip, turn_id or turn"
        )
    items = {_key(item, key): item for item in sitting.items}
    found, seen = [], set[str]()
    for row in rows:
        where = f"{path}, line {rows.line_num}"
        name = (row[key] or "").strip()
        if name not in items:
            raise GameError(
                f"{where}: {key} '{name}' is no trial of this session; see nao-sim score {sitting.folder.path}"
            )
        if name in seen:
            raise GameError(f"{where}: {key} '{name}' stands there twice; keep one of the lines")
        seen.add(name)
        found.append(_line(where, items[name], row, sitting.keys))
    return found


def _key(item: Item, key: str) -> str:
    return {"clip": _clip(item), "turn_id": item.turn.turn_id, "turn": str(item.turn.turn)}[key]


def _line(where: str, item: Item, row: dict[str, str], keys: tuple[str, ...]) -> _Line | None:
    score, excluded, note = ((row.get(name) or "").strip() for name in ("score", "excluded", "note"))
    reason = excluded.replace(" ", "_")
    if score and reason:
        raise GameError(f"{where}: has a score and a reason why it is no trial; keep one of them")
    if score and score not in keys:
        raise GameError(f"{where}: score is '{score}'; write {', '.join(keys)}, or nothing")
    if reason and reason not in EXCLUSIONS:
        raise GameError(f"{where}: excluded is '{excluded}'; write one of {', '.join(EXCLUSIONS)}")
    if not score and not reason:
        return None
    return _Line(item, int(score) if score else None, reason or None, note)
