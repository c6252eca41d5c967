"""Gestures in the project's own TOML, written; :mod:`nao_sim.gestures.loader` reads them."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np

from nao_sim.gestures.formats.text_file import write_whole
from nao_sim.gestures.vocabulary import vocabulary
from nao_sim.motion.curves import Curve, union_of_times
from nao_sim.motion.limits import unit_of


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion as key frames, degrees; a joint stands in those in which it has a key."""
    straight = {name: curve.straight() for name, curve in curves.items()}
    known = path.stem in vocabulary()
    name = f"{path.stem}_motion" if known else path.stem
    lines = [f"name = {_quoted(name)}", 'easing = "linear"']
    for time in union_of_times(straight).tolist():
        angles = []
        for joint, curve in straight.items():
            row = int(np.searchsorted(curve.times, time))
            if row < len(curve.times) and curve.times[row] == time:
                value = f"{curve.values[row] * unit_of(joint)[1]:.5f}".rstrip("0").rstrip(".")
                angles.append(f"{joint} = {'0' if value == '-0' else value}")
        lines += ["", "[[key_frame]]", f"time = {round(time, 6)!r}", f"angles = {{ {', '.join(angles)} }}"]
    write_whole(path, "\n".join(lines) + "\n")
    return [f"named '{name}', because '{path.stem}' is in the vocabulary"] if known else []


def _quoted(text: str) -> str:
    plain = "".join(sign if sign.isprintable() else "_" for sign in text)
    return '"' + plain.replace("\\", "\\\\").replace('"', '\\"') + '"'
