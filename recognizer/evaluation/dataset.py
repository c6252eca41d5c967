"""From a folder of labelled clips to a feature database."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Callable
from pathlib import Path
from typing import Any

import joblib
import numpy as np
import pyarrow as pa
import pyarrow.csv as pacsv
import pyarrow.parquet as pq

from recognizer.errors import ClipError, DatabaseError
from recognizer.learning.database import IRRELEVANT, Database
from recognizer.methods import METHODS
from recognizer.tracking import track_clip
from recognizer.video.clip import open_clip

REQUIRED = ("file", "label", "person")


@dataclasses.dataclass(frozen=True)
class Entry:
    """One clip of a data set: its path, label, detail of the label, person, and frame range."""

    path: Path
    name: str
    label: str
    action: str
    person: str
    frames: tuple[int, int | None] | None = None


def read_manifest(dataset: str | os.PathLike[str]) -> list[Entry]:
    """Read ``manifest.parquet`` or ``manifest.csv`` of a data set folder.

    Columns: file, label, person; optional action (what exactly, for irrelevant motion), start and end
    (first and last frame, both included). A label that begins with "irrelevant" is irrelevant motion.

    Raises:
        DatabaseError: no manifest, columns missing, or files that it names are missing.
    """
    root = Path(dataset)
    table = _manifest_table(root)
    missing = [name for name in REQUIRED if name not in table.column_names]
    if missing:
        raise DatabaseError(
            f"the manifest of {root} has no column {', '.join(missing)}; it needs {', '.join(REQUIRED)}"
        )
    entries = [_entry(root, row) for row in table.to_pylist()]
    if not entries:
        raise DatabaseError(f"the manifest of {root} is empty; film or import clips first")
    absent = [entry.name for entry in entries if not entry.path.is_file()]
    if absent:
        more = f" and {len(absent) - 1} more" if len(absent) > 1 else ""
        raise DatabaseError(
            f"{root}: the manifest names {absent[0]}{more}, which is not there; restore or remove the rows"
        )
    return entries


def _manifest_table(root: Path) -> pa.Table:
    if (root / "manifest.parquet").is_file():
        try:
            return pq.read_table(root / "manifest.parquet")
        except (pa.ArrowException, OSError):
            raise DatabaseError(f"{root}/manifest.parquet cannot be read; make the data set again") from None
    if (root / "manifest.csv").is_file():
        try:
            return pacsv.read_csv(root / "manifest.csv")
        except pa.ArrowException as error:
            raise DatabaseError(f"{root}/manifest.csv: {error}") from None
    raise DatabaseError(f"{root} is not a data set: it has no manifest.parquet or manifest.csv")


def _entry(root: Path, row: dict[str, Any]) -> Entry:
    label = str(row["label"])
    action = str(row.get("action") or label)
    if label.startswith(IRRELEVANT):
        action = action if action != label else label.removeprefix(IRRELEVANT).strip("_:/") or IRRELEVANT
        label = IRRELEVANT
    first, last = row.get("start"), row.get("end")
    # Parquet written by other tools may hold NaN where there is no number.
    frames = (0 if _missing(first) else int(first or 0), None if _missing(last) else int(last or 0))
    return Entry(root / str(row["file"]), str(row["file"]), label, action, str(row["person"]), frames)


def _missing(value: Any) -> bool:
    return value is None or value == "" or (isinstance(value, float) and math.isnan(value))


def clip_features(entry: Entry, method: str) -> np.ndarray | str:
    """Describe one clip; a string says why it could not be read."""
    body = METHODS[method].needs_body
    try:
        return METHODS[method].features(track_clip(open_clip(entry.path, entry.frames), body, mirrored=body))
    except ClipError as error:
        return str(error)


def build_database(
    entries: list[Entry],
    families: dict[str, str],
    method: str,
    jobs: int = 2,
    progress: Callable[[int, int], None] | None = None,
    provenance: dict[str, Any] | None = None,
    mirror: dict[str, str] | None = None,
) -> tuple[Database, list[str]]:
    """Describe all clips of a data set.

    Args:
        entries: from :func:`read_manifest`.
        families: gesture label -> "small" or "large"; rows of other families are an error.
        method: name of the feature method.
        jobs: processes.
        progress: called with clips done and their number.
        provenance: what to write down about how it was made.
        mirror: gesture label -> label of the mirrored motion; empty when left and right are not exchanged.

    Returns:
        The database, and one line for each clip that could not be used.

    Raises:
        DatabaseError: a label is unknown, or no clip could be used.
    """
    unknown = sorted({e.label for e in entries} - set(families) - {IRRELEVANT})
    if unknown:
        raise DatabaseError(
            f"the manifest has labels that the vocabulary has not: {', '.join(unknown)}; add or rename them"
        )
    work = joblib.Parallel(n_jobs=jobs, return_as="generator", batch_size=8)
    vectors: list[np.ndarray | str] = []
    for vector in work(joblib.delayed(clip_features)(entry, method) for entry in entries):
        vectors.append(vector)
        if progress is not None:
            progress(len(vectors), len(entries))
    used = [(e, v) for e, v in zip(entries, vectors, strict=True) if not isinstance(v, str)]
    problems = [v for v in vectors if isinstance(v, str)]
    if not used:
        raise DatabaseError(f"none of the {len(entries)} clips could be used; the first: {problems[0]}")
    extractor = METHODS[method]
    return (
        Database(
            features=np.array([v for _, v in used], np.float32),
            labels=np.array([e.label for e, _ in used]),
            families=np.array([families.get(e.label, IRRELEVANT) for e, _ in used]),
            actions=np.array([e.action for e, _ in used]),
            persons=np.array([e.person for e, _ in used]),
            sources=np.array([e.name for e, _ in used]),
            names=extractor.names,
            method=method,
            version=extractor.version,
            mirror=mirror or {},
            provenance=provenance or {},
            bits=extractor.bits,
        ).rounded(),
        problems,
    )
