"""The feature database: a Parquet table of labelled vectors with provenance. It is the whole model of KNN."""

from __future__ import annotations

import dataclasses
import io
import json
import os
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq

from recognizer.errors import DatabaseError

IRRELEVANT = "irrelevant"  # family and label of motions that must not be answered
CLIPPED = 0.002  # share of a feature's values at either end that a few bits are not spent on


@dataclasses.dataclass(frozen=True)
class Rows:
    """What is known of rows beside their features; columns as in :class:`Database`, (n,) str each."""

    labels: np.ndarray
    families: np.ndarray
    actions: np.ndarray
    persons: np.ndarray
    sources: np.ndarray

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.labels)

    def take(self, rows: np.ndarray) -> Rows:
        """Return the rows of a mask or index array."""
        return Rows(*(getattr(self, name)[rows] for name in _TEXT))

    def with_others(self, others: Rows) -> Rows:
        """Return these rows and others after them."""
        return Rows(*(np.concatenate([getattr(rows, name) for rows in (self, others)]) for name in _TEXT))


@dataclasses.dataclass(frozen=True)
class Database:
    """Labelled feature vectors.

    Attributes:
        features: (n, d) float32.
        labels: (n,) str, a gesture's name or "irrelevant".
        families: (n,) str, "small", "large", "static" or "irrelevant".
        actions: (n,) str, what exactly was done; equals the label except for irrelevant motions.
        persons: (n,) str.
        sources: (n,) str, the clip each row was made of.
        names: (d,) names of the features.
        method: name of the feature extractor.
        version: its version; a database of another version is refused.
        mirror: label -> label of the same motion with left and right exchanged.
        provenance: how it was made (command, data set, seeds, scores), JSON-able.
        arrays: what was learned from the rows (projection, threshold …), by name.
        bits: 2 to 16, in which each feature is stored, over its own range; of 8 or fewer none are spent on the
            outermost values.
    """

    features: np.ndarray
    labels: np.ndarray
    families: np.ndarray
    actions: np.ndarray
    persons: np.ndarray
    sources: np.ndarray
    names: tuple[str, ...]
    method: str
    version: int
    mirror: dict[str, str] = dataclasses.field(default_factory=dict)
    provenance: dict[str, Any] = dataclasses.field(default_factory=dict)
    arrays: dict[str, np.ndarray] = dataclasses.field(default_factory=dict)
    bits: int = 16

    def __post_init__(self) -> None:
        """Refuse what cannot be learned from."""
        n = len(self.labels)
        columns = (self.families, self.actions, self.persons, self.sources)
        if self.features.shape != (n, len(self.names)) or any(len(c) != n for c in columns):
            raise DatabaseError(
                f"database columns differ in length: {n} labels, features {self.features.shape}; train it again"
            )
        if n == 0:
            raise DatabaseError("the database has no rows; train it on a data set with clips")
        if not np.isfinite(self.features).all():
            row = int(np.flatnonzero(~np.isfinite(self.features).all(axis=1))[0])
            raise DatabaseError(
                f"row {row} of the database ({self.sources[row]}) is not finite; train it again without that clip"
            )

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.labels)

    @property
    def rows(self) -> Rows:
        """All columns but the features."""
        return Rows(*(getattr(self, name) for name in _TEXT))

    def take(self, rows: np.ndarray) -> Database:
        """Return the rows of a mask or index array; what was learned from all rows is dropped."""
        columns = {name: getattr(self, name)[rows] for name in ("features", *_TEXT)}
        return dataclasses.replace(self, **columns, arrays={})

    def rounded(self) -> Database:
        """Return the database as it will be read back, so that what is learned from it holds for what is stored."""
        codes, low, step = self._codes()
        return dataclasses.replace(self, features=_decoded(codes, low, step))

    def _codes(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        clipped = CLIPPED if self.bits <= 8 else 0.0
        # Values that occur, so that rounding twice is rounding once.
        low = np.quantile(self.features, clipped, axis=0, method="lower").astype(np.float64)
        high = np.quantile(self.features, 1 - clipped, axis=0, method="higher").astype(np.float64)
        step = np.maximum(high - low, 1e-12) / (2**self.bits - 1)
        codes = np.round((self.features.clip(low, high) - low) / step)
        return codes.astype(_code(self.bits)), low, step

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the table atomically.

        Raises:
            DatabaseError: the place cannot be written.
        """
        codes, low, step = self._codes()
        # One string of bytes a row: Parquet would widen small integers to 32 bits.
        vectors = pa.array([row.tobytes() for row in codes], pa.binary(codes.shape[1] * codes.itemsize))
        text = {name: pa.array(getattr(self, name).tolist(), pa.string()) for name in _TEXT}
        header = {name: getattr(self, name) for name in _HEADER}
        packed = io.BytesIO()
        arrays: dict[str, Any] = {"low": low, "step": step, **{f"_{k}": v for k, v in self.arrays.items()}}
        np.savez_compressed(packed, **arrays)
        table = pa.table({**text, "features": vectors})
        table = table.replace_schema_metadata(
            {b"recognizer": json.dumps(header).encode(), b"arrays": packed.getvalue()}
        )
        target = Path(path)
        temporary = target.with_name(f".{target.name}.{os.getpid()}")
        try:
            target.parent.mkdir(parents=True, exist_ok=True)
            pq.write_table(table, temporary, compression="zstd", compression_level=9, use_dictionary=list(_TEXT))
            os.replace(temporary, target)
        except OSError as error:
            temporary.unlink(missing_ok=True)
            raise DatabaseError(f"cannot write {target}: {error.strerror or error}; choose another place") from None

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> Database:
        """Read a table that :meth:`save` wrote; nothing in it is executed.

        Raises:
            DatabaseError: missing, not such a table, or damaged.
        """
        file = Path(path)
        if not file.is_file():
            raise DatabaseError(f"{file}: no such database; make one with 'nao-sim train DATASET --out {file.name}'")
        try:
            table = pq.read_table(file)
            meta = table.schema.metadata or {}
            written = json.loads(meta[b"recognizer"])
            written.setdefault("bits", 16)
            header: dict[str, Any] = {name: written[name] for name in _HEADER}
            with np.load(io.BytesIO(meta[b"arrays"]), allow_pickle=False) as packed:
                arrays = {name: packed[name] for name in packed.files}
            width = len(header["names"])
            code = _code(int(header["bits"]))
            codes = np.frombuffer(b"".join(table["features"].to_pylist()), code).reshape(len(table), width)
            text: dict[str, Any] = {name: np.array(table[name].to_pylist(), dtype=str) for name in _TEXT}
            features = _decoded(codes, arrays.pop("low"), arrays.pop("step"))
        except (pa.ArrowException, KeyError, ValueError, TypeError, OSError, EOFError) as error:
            raise DatabaseError(f"{file} is not a feature database ({type(error).__name__}); train it again") from None
        header["names"] = tuple(header["names"])
        learned = {name[1:]: value for name, value in arrays.items()}
        return cls(features=features, **text, **header, arrays=learned)


def _code(bits: int) -> str:
    """Smallest type that holds so many bits."""
    return "u1" if bits <= 8 else "<u2"


def _decoded(codes: np.ndarray, low: np.ndarray, step: np.ndarray) -> np.ndarray:
    features: np.ndarray = codes * step.astype(np.float32)
    features += low.astype(np.float32)
    return features


_HEADER = ("method", "version", "names", "mirror", "provenance", "bits")
_TEXT = ("labels", "families", "actions", "persons", "sources")
