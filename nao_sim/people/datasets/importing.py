"""Making a data set of one's own recordings: a manifest that points at them, without copying them."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

from nao_sim.errors import did_you_mean
from nao_sim.people.datasets.checking import inspect
from nao_sim.people.datasets.manifest import known_labels, read_table, write_manifest
from nao_sim.people.errors import FilmError

VIDEO = (".avi", ".mp4", ".mkv", ".mov", ".webm", ".m4v", ".mpg", ".mpeg")
PHOTO = (".jpg", ".jpeg", ".png", ".bmp")
COLUMNS = ("file", "start", "end", "label", "person")


def find(source: Path) -> list[dict[str, Any]]:
    """List the recordings of ``source``: rows with ``path``, ``label``, ``person`` and perhaps ``start`` and ``end``.

    Args:
        source: a folder with ``<label>/<person>_<take>.<ext>`` or ``<label>/<person>/<any>.<ext>``, or a CSV table with
            the columns ``file,start,end,label,person``; its files are relative to the table.

    Raises:
        FilmError: nothing is found, a label is unknown, or it is not said who performs.
    """
    if source.is_dir():
        rows = list(_of_folder(source))
    elif source.suffix.lower() == ".csv" and source.is_file():
        rows = list(_of_table(source))
    else:
        raise FilmError(f"{source} is neither a folder of recordings nor a table '{','.join(COLUMNS)}' (.csv)")
    if not rows:
        raise FilmError(f"{source} has no recordings; expected <label>/<person>_<take>.avi, .mp4 or .jpg")
    labels = known_labels()
    for row in rows:
        if row["label"] not in labels:
            raise FilmError(f"{row['path']}: unknown label '{row['label']}'{did_you_mean(row['label'], labels)}")
    return rows


def _of_folder(source: Path) -> Iterator[dict[str, Any]]:
    for path in sorted(source.rglob("*")):
        if path.suffix.lower() not in VIDEO + PHOTO or path.name.startswith("."):
            continue
        inside = path.relative_to(source).parts
        if len(inside) == 3:
            person = inside[1]
        elif len(inside) == 2 and "_" in path.stem:
            person = path.stem.rsplit("_", 1)[0]
        else:
            raise FilmError(f"{path} does not say who does what; name it <label>/<person>_<take>{path.suffix}")
        yield {"path": path, "label": inside[0], "person": person}


def _of_table(source: Path) -> Iterator[dict[str, Any]]:
    for number, row in enumerate(read_table(source), start=2):
        missing = [name for name in ("file", "label", "person") if not row.get(name)]
        if missing:
            raise FilmError(f"{source}, line {number}: no '{missing[0]}'; the columns are {','.join(COLUMNS)}")
        frames = {name: row[name] for name in ("start", "end") if row.get(name) not in (None, "")}
        yield {"path": source.parent / row["file"], "label": row["label"], "person": row["person"], **frames}


def import_recordings(rows: Sequence[dict[str, Any]], out: Path) -> Iterator[dict[str, Any]]:
    """Read each recording of :func:`find`, yield its manifest row, and at the end write the manifest into ``out``.

    Raises:
        FilmError: a recording cannot be read, or does not have the frames that the table names.
    """
    out.mkdir(parents=True, exist_ok=True)
    made: list[dict[str, Any]] = []
    for row in rows:
        seen, _ = inspect(row["path"])
        if seen is None:
            raise FilmError(f"{row['path']} cannot be read; is it there, and a video or a photo?")
        start, end = int(row.get("start", 0)), int(row.get("end", seen.frames - 1))
        if not 0 <= start <= end < seen.frames:
            raise FilmError(f"{row['path']} has {seen.frames} frames; {start} to {end} are not among them")
        made.append({
            "file": Path(os.path.relpath(row["path"].resolve(), out.resolve())).as_posix(),
            "label": row["label"],
            "person": row["person"],
            "take": sum(other["label"] == row["label"] and other["person"] == row["person"] for other in made),
            "action": row["label"],
            "fps": seen.fps,
            "frames": seen.frames,
            "width": seen.width,
            "height": seen.height,
            "start": start,
            "end": end,
        })  # fmt: skip
        yield made[-1]
    write_manifest(out, made)
