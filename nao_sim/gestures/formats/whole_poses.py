"""For formats whose every line is a whole pose: joints that a motion does not name, and the times between its keys."""

from __future__ import annotations

from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from nao_sim.motion.curves import Curve, rows_of, union_of_times
from nao_sim.robot.postures import posture

REST = "StandInit"


def whole_poses(
    curves: Mapping[str, Curve], names: Sequence[str]
) -> tuple[NDArray[np.float64], NDArray[np.float64], list[str]]:
    """Return times (n,), poses of all ``names`` (n, k) in rad, and a note of what had to be filled in.

    A joint holds its first key before it and its last one after it.
    """
    straight = {name: curve.straight() for name, curve in curves.items()}
    times = union_of_times(straight)
    home, known = posture(REST), dict(zip(straight, rows_of(straight, times).T, strict=True))
    columns = []
    for name in names:
        leader = "LHipYawPitch" if name == "RHipYawPitch" else name
        column = known.get(leader, np.full(len(times), home[leader]))
        if leader in straight:
            first, last = straight[leader].values[[0, -1]]
            column = np.where(np.isnan(column), np.where(times < straight[leader].times[0], first, last), column)
        columns.append(column)
    missing = [name for name in names if name not in curves and name != "RHipYawPitch"]
    notes = [f"{len(missing)} joints that the motion does not name are written as in {REST}"] if missing else []
    return times, np.stack(columns, axis=1), notes
