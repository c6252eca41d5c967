"""DREAM 1.1: a filmed child's joints and head's heading, as far as they are known.

What is not known is null; nothing is derived or invented. Positions are millimetres in the camera's frame, y negative
below it, as in the data set; gaze is a unit vector of heading. The schema requires the spelling ``sholder``, does not
see unequal lengths, NaN or a frame rate of 0 (we do), and knows no robot. It names conditions RET and SHT; ours stands
beside it as ``nao_sim_condition``.
"""

from __future__ import annotations

import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any

from nao_sim.exchange.errors import ExchangeError

JOINTS = (
    "elbow_left", "elbow_right", "hand_left", "hand_right", "head", "sholder_center", "sholder_left", "sholder_right",
    "wrist_left", "wrist_right",
)  # fmt: skip
CONDITIONS = {"triadic": "RET", "dyadic": "SHT"}

Samples = Sequence[float | None]


@dataclass(frozen=True)
class JointTrack:
    """One joint over time: x, y, z [mm] and confidence (0 to 1); None where it was not seen."""

    x: Samples
    y: Samples
    z: Samples
    confidence: Samples


@dataclass(frozen=True)
class ChildTrack:
    """What was measured of a filmed child.

    Attributes:
        frame_rate: samples a second, as measured.
        joints: by DREAM's names (``shoulder`` is understood); absent ones become null.
        head_gaze, eye_gaze: unit vectors of heading, three rows of samples; None where not measured.
    """

    frame_rate: float
    joints: Mapping[str, JointTrack]
    head_gaze: tuple[Samples, Samples, Samples] | None = None
    eye_gaze: tuple[Samples, Samples, Samples] | None = None
    extra: Mapping[str, Any] = field(default_factory=dict)


def dream_document(
    track: ChildTrack, participant: int, condition: str, task: str, date: str | None = None
) -> dict[str, Any]:
    """Return a DREAM 1.1 document.

    Args:
        track: what was measured.
        participant: the schema wants an integer; a pseudonym goes into ``track.extra``.
        condition: triadic or dyadic.
        task: what was done, in words.
        date: ISO 8601.

    Raises:
        ExchangeError: nothing was measured, lengths differ, or a value is out of its range.
    """
    joints = {name.replace("shoulder", "sholder"): joint for name, joint in track.joints.items()}
    for name in joints:
        if name not in JOINTS:
            raise ExchangeError(f"DREAM has no joint {name!r}; it has {', '.join(JOINTS)}")
    if not (math.isfinite(track.frame_rate) and track.frame_rate > 0):
        raise ExchangeError(f"the frame rate is {track.frame_rate}; DREAM needs the measured one, above 0")
    rows = [*(s for j in joints.values() for s in (j.x, j.y, j.z, j.confidence))]
    rows += [s for gaze in (track.head_gaze, track.eye_gaze) if gaze is not None for s in gaze]
    lengths = {len(row) for row in rows}
    if len(lengths) != 1 or lengths == {0}:
        what = "nothing was measured" if not any(lengths) else f"joints have {sorted(lengths)} samples"
        raise ExchangeError(f"{what}; DREAM needs one length for all")
    n = lengths.pop()
    return {
        "$id": "https://raw.githubusercontent.com/dream2020/data/master/specification/dream.1.1.json",
        "participant": {"id": int(participant)},
        "condition": CONDITIONS[condition],
        "nao_sim_condition": condition,
        **({} if date is None else {"date": date}),
        "task": task,
        "frame_rate": float(track.frame_rate),
        "eye_gaze": _gaze(track.eye_gaze, n, "eye_gaze"),
        "head_gaze": _gaze(track.head_gaze, n, "head_gaze"),
        "skeleton": {name: _joint(joints.get(name), n, name) for name in JOINTS},
        **track.extra,
    }


def dream_bytes(document: Mapping[str, Any]) -> bytes:
    """Return a document as a file's bytes; the token NaN, which Python would write, cannot be in it."""
    return json.dumps(document, ensure_ascii=False, allow_nan=False).encode() + b"\n"


def _joint(track: JointTrack | None, n: int, name: str) -> dict[str, list[float | None]]:
    if track is None:
        return {key: [None] * n for key in ("x", "y", "z", "confidence")}
    return {key: _samples(getattr(track, key), f"{name}.{key}") for key in ("x", "y", "z", "confidence")}


def _gaze(rows: tuple[Samples, Samples, Samples] | None, n: int, name: str) -> dict[str, list[float | None]]:
    if rows is None:
        return {key: [None] * n for key in ("rx", "ry", "rz")}
    found = {k: _samples(r, f"{name}.{k}") for k, r in zip(("rx", "ry", "rz"), rows, strict=True)}
    for i, (x, y, z) in enumerate(zip(*found.values(), strict=True)):
        if x is not None and y is not None and z is not None and not 0.95 <= math.hypot(x, y, z) <= 1.05:
            raise ExchangeError(f"{name} sample {i + 1} has length {math.hypot(x, y, z):.3f}; a heading has length 1")
    return found


def _samples(row: Samples, name: str) -> list[float | None]:
    found: list[float | None] = []
    for i, value in enumerate(row):
        if value is not None and not math.isfinite(value):
            raise ExchangeError(f"{name} sample {i + 1} is {value}; leave out what was not seen")
        found.append(None if value is None else float(value))
    return found
