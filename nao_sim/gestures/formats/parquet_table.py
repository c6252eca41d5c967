"""Joint angles in Parquet: our own ``episode.parquet``, LeRobot's episodes, and tables with headers as in CSV.

Of our episodes the targets are read (``HeadYaw.target``), or what was measured (``.angle``); of LeRobot's data sets the
column ``action``, or ``observation.state``, with the joints' names from ``meta/info.json``.
"""

from __future__ import annotations

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile, of_rows
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import check_file
from nao_sim.gestures.formats.units import angles_in_rad, joint_scale, split_header, time_column, times_in_s
from nao_sim.motion.curves import Curve, rows_of, union_of_times
from nao_sim.motion.limits import HANDS
from nao_sim.robot.joints import BODY

_MAX_BYTES = 1_000_000_000
_MOST_ROWS = 2_000_000
_SUFFIXES = (".pos", ".position", ".target", ".angle")


def read(path: Path, said: Said) -> MotionFile:
    """Read a table of joint angles.

    Raises:
        GestureFileError: not such a table, or several episodes and none chosen.
    """
    columns, units = _schema(path)
    ours = {name: f"{name}.{'angle' if said.measured else 'target'}" for name in BODY}
    ours = {name: column for name, column in ours.items() if column in columns}
    if ours:
        table = _load(path, ["time", *ours.values()])
        rows = np.stack([table[column] for column in ours.values()], axis=1)
        return _motion(path, said, list(ours), rows, table["time"], units.get("time", "s"), ["rad"] * len(ours), [])
    vector = "observation.state" if said.measured else "action"
    vector = vector if vector in columns else "observation.state"
    if vector in columns and "timestamp" in columns:
        return _lerobot(path, said, vector, columns)
    at = next((column for column in columns if time_column(column)[0]), None)
    joints = [column for column in columns if split_header(column)[0] in BODY]
    if at is None or not joints:
        raise GestureFileError(
            path, "has no joint columns that are known: <joint>.target, action, or <joint>_rad with a time"
        )
    table = _load(path, [at, *joints])
    heads = [split_header(column) for column in joints]
    rows = np.stack([table[column] for column in joints], axis=1)
    names, said_units = [name for name, _ in heads], [unit for _, unit in heads]
    return _motion(path, said, names, rows, table[at], time_column(at)[1], said_units, [])


def is_motion(path: Path) -> bool:
    """Return whether a table has columns that are read as joint angles."""
    try:
        columns, _ = _schema(path)
    except GestureFileError:
        return False
    vectors = {"action", "observation.state"} & set(columns)
    named = any(split_header(column)[0] in BODY or column.removesuffix(".target") in BODY for column in columns)
    return named or bool(vectors and "timestamp" in columns)


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion as ``time`` (s) and ``<joint>.target`` (rad), a row a key, units in the columns' metadata."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    times = union_of_times({name: curve.straight() for name, curve in curves.items()})
    fields, arrays = [pa.field("time", pa.float64(), metadata={"unit": "s"})], [pa.array(times)]
    for name, column in zip(curves, rows_of(curves, times).T, strict=True):
        unit = "1" if name in HANDS else "rad"
        fields.append(pa.field(f"{name}.target", pa.float64(), metadata={"unit": unit}))
        arrays.append(pa.array(np.ascontiguousarray(column), from_pandas=True))
    beside = path.with_name(f".{path.name}.part")
    try:
        pq.write_table(pa.Table.from_arrays(arrays, schema=pa.schema(fields)), beside)
        beside.replace(path)
    except OSError as error:
        raise GestureFileError(path, f"cannot be written ({error.strerror or error}); choose another place") from None
    finally:
        beside.unlink(missing_ok=True)
    return []


def _schema(path: Path) -> tuple[list[str], dict[str, str]]:
    """Return the columns' names and the units in their metadata."""
    import pyarrow as pa
    import pyarrow.parquet as pq

    check_file(path, _MAX_BYTES)
    try:
        schema = pq.read_schema(path)
        rows = pq.read_metadata(path).num_rows
    except (pa.ArrowException, OSError) as error:
        raise GestureFileError(path, f"is not a Parquet table ({str(error).splitlines()[0]})") from None
    if rows > _MOST_ROWS:
        raise GestureFileError(path, f"has {rows} rows; a motion has at most {_MOST_ROWS}")
    units = {
        field.name: field.metadata[b"unit"].decode() for field in schema if field.metadata and b"unit" in field.metadata
    }
    return list(schema.names), units


def _load(path: Path, columns: list[str]) -> dict[str, NDArray[np.float64]]:
    import pyarrow.parquet as pq

    table = pq.read_table(path, columns=columns)
    loaded = {}
    for name in columns:
        values = np.array(table[name].to_pylist() or [], dtype=object)
        try:
            loaded[name] = np.array([np.nan if value is None else value for value in values], dtype=float)
        except (TypeError, ValueError):
            raise GestureFileError(path, f"column '{name}' is not one of numbers") from None
    return loaded


def _motion(
    path: Path,
    said: Said,
    names: list[str],
    rows: NDArray[np.float64],
    times: NDArray[np.float64],
    time_unit: str | None,
    units: list[Any],
    notes: list[str],
) -> MotionFile:
    names = [checks.joint_name(name, path, "column") for name in names]
    scales = [
        joint_scale(None if name in HANDS and unit == "rad" else unit, name, path, "column")
        for name, unit in zip(names, units, strict=True)
    ]
    seconds, told = times_in_s(times, time_unit, path, said)
    angles, concluded = angles_in_rad(names, scales, rows, path, said)
    kept: dict[str, int] = {}
    for column, name in enumerate(names):
        kept.setdefault(name, column)
    return of_rows(path, list(kept), seconds, angles[:, list(kept.values())], [*notes, *told, *concluded])


def _lerobot(path: Path, said: Said, vector: str, columns: list[str]) -> MotionFile:
    import pyarrow.parquet as pq

    wanted = [name for name in ("timestamp", "episode_index", vector) if name in columns]
    table = pq.read_table(path, columns=wanted)
    episodes = np.array(table["episode_index"].to_pylist()) if "episode_index" in columns else np.zeros(len(table), int)
    known = sorted({int(episode) for episode in episodes})
    if said.part is None and len(known) > 1:
        raise GestureFileError(path, f"holds {len(known)} episodes ({known[0]} to {known[-1]}); choose one with --part")
    if said.part is not None and said.part not in map(str, known):
        raise GestureFileError(path, f"has no episode '{said.part}'; known: {known[0]} to {known[-1]}")
    rows = np.flatnonzero(episodes == (int(said.part) if said.part is not None else (known or [0])[0]))
    table = table.take(rows)
    poses = np.array(table[vector].to_pylist(), dtype=float).reshape(len(rows), -1)
    names = _names(path, vector, poses.shape[1])
    heads = [split_header(_bare(name)) for name in names]
    kept = [index for index, (name, _) in enumerate(heads) if name in BODY]
    if not kept:
        raise GestureFileError(path, f"{vector} names no joint of a NAO ({', '.join(names[:4])}, ...)")
    left = len(names) - len(kept)
    notes = [f"'{vector}' is read"] + ([f"{left} numbers that are no joint angles are left out"] if left else [])
    times = np.array(table["timestamp"].to_pylist(), dtype=float)
    return _motion(
        path,
        said,
        [heads[index][0] for index in kept],
        poses[:, kept],
        times - times[:1].sum(),
        "s",
        [heads[index][1] for index in kept],
        notes,
    )


def _bare(name: str) -> str:
    return next((name.removesuffix(suffix) for suffix in _SUFFIXES if name.endswith(suffix)), name)


def _names(path: Path, vector: str, width: int) -> list[str]:
    """Return the names of a vector's numbers from the data set's ``meta/info.json``."""
    info = next(
        (
            parent / "meta" / "info.json"
            for parent in path.resolve().parents[:4]
            if (parent / "meta" / "info.json").is_file()
        ),
        None,
    )
    if info is None:
        raise GestureFileError(path, f"'{vector}' has no names: no meta/info.json above it; keep it in its data set")
    try:
        names = json.loads(info.read_text(encoding="utf-8"))["features"][vector]["names"]
    except (ValueError, KeyError, TypeError, OSError):
        names = None
    if isinstance(names, dict):
        names = next(iter(names.values()), None)
    if not isinstance(names, list) or len(names) != width:
        raise GestureFileError(path, f"'{vector}' has {width} numbers, and {info.name} does not name them all")
    return [str(name) for name in names]
