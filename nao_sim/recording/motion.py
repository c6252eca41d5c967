"""The joints of a Rerun recording of ours as a motion."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from nao_sim.gestures import checks
from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.motion_file import MotionFile
from nao_sim.gestures.formats.said import Said
from nao_sim.gestures.formats.text_file import check_file
from nao_sim.motion.curves import Curve
from nao_sim.motion.limits import HANDS
from nao_sim.recording.moments import TIMELINE
from nao_sim.robot.joints import ACTUATED

_MAX_BYTES = 2_000_000_000
# The robot stands while the clip is watched: a gap of this kind at the beginning is not part of the motion.
_GAP_S = 0.1


def read(path: Path, said: Said) -> MotionFile:
    """Read what the joints were asked, or what they did (``said.measured``), from an ``.rrd`` file.

    Raises:
        GestureFileError: not a recording, or none with joints of ours.
    """
    check_file(path, _MAX_BYTES)
    kind = "angle" if said.measured else "target"
    samples = _samples(path, {f"/joints/{name}/{kind}": name for name in ACTUATED})
    if not samples:
        raise GestureFileError(
            path, f"has no joints/<joint>/{kind} on the time line '{TIMELINE}'; is it a recording of ours?"
        )
    notes, start = [], 0.0
    first = next(iter(samples.values()))[0]
    if len(first) > 1 and first[1] - first[0] > _GAP_S:
        start = float(first[1])
        notes.append(f"starts at {start:.2f} s of the recording, with the robot's motion")
    curves = {}
    for name in (name for name in ACTUATED if name in samples):
        times, values = samples[name]
        moving = times >= start - 1e-9
        scale = 0.01 if name in HANDS else float(np.deg2rad(1.0))
        curves[name] = Curve(times[moving] - start, values[moving] * scale)
    checks.not_too_long(max(float(curve.times[-1]) for curve in curves.values()), path, said.longest_s)
    return MotionFile(path, curves, tuple(notes))


def _samples(path: Path, entities: dict[str, str]) -> dict[str, tuple[np.ndarray, np.ndarray]]:
    import pyarrow as pa
    import pyarrow.compute as pc
    from rerun.chunk import RrdReader

    found: dict[str, list[tuple[np.ndarray, np.ndarray]]] = {}
    try:
        for chunk in RrdReader(str(path)).stream():
            name = entities.get(str(chunk.entity_path))
            if name is None or chunk.is_static or TIMELINE not in chunk.timeline_names:
                continue
            batch = chunk.to_record_batch()
            if "Scalars:scalars" not in batch.schema.names:
                continue
            times = batch[TIMELINE].cast(pa.int64()).to_numpy() * 1e-9
            found.setdefault(name, []).append((times, pc.list_flatten(batch["Scalars:scalars"]).to_numpy()))
    except Exception as error:  # Rerun raises RuntimeError, ValueError and its own errors alike
        raise GestureFileError(path, f"is not a Rerun recording ({' '.join(str(error).split())[:120]})") from None
    joined = {}
    for name, parts in found.items():
        times, order = np.unique(np.concatenate([part[0] for part in parts]), return_index=True)
        joined[name] = times, np.concatenate([part[1] for part in parts])[order]
    return joined
