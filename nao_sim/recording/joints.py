"""Joint angles inside their limits, torques, and balance, as time series."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from nao_sim.recording.moments import column

if TYPE_CHECKING:
    import rerun as rr

_STYLE = {
    "angle": ([46, 125, 210], 2.5),
    "target": ([240, 150, 30], 1.2),
    "min": ([200, 60, 60], 1.0),
    "max": ([200, 60, 60], 1.0),
}


def _series(stream: rr.RecordingStream, path: str, time: np.ndarray, values: np.ndarray, name: str) -> None:
    import rerun as rr

    key = path.rsplit("/", 1)[-1]
    colour, width = _STYLE.get(key, (None, 1.5))
    style = rr.SeriesLines(names=[name], widths=[width], colors=None if colour is None else [colour])
    stream.log(path, style, static=True)
    stream.send_columns(path, indexes=column(time), columns=rr.Scalars.columns(scalars=values))


def in_display_units(names: Sequence[str], values: np.ndarray) -> np.ndarray:
    """Degrees for angles, percent for the hands' opening (0 closed … 100 open); last axis as ``names``."""
    is_hand = np.array([name.endswith("Hand") for name in names])
    return np.where(is_hand, 100.0 * values, np.degrees(values))


def log_joints(
    stream: rr.RecordingStream,
    names: Sequence[str],
    joint_range: np.ndarray,
    time: np.ndarray,
    targets: np.ndarray,
    angles: np.ndarray,
    torques: np.ndarray,
) -> None:
    """Log each joint's angle, target and both limits (degrees, hands in percent) and its torque [Nm].

    Args:
        stream: an open recording.
        names: joint names, length j.
        joint_range: lower and upper limit, radians (hands 0 … 1), shape (j, 2).
        time: seconds on the recording's timeline, shape (n,).
        targets: commanded angles, radians (hands 0 … 1), shape (n, j).
        angles: measured angles, same units and shape.
        torques: actuator torque at the joint [Nm], shape (n, j).
    """
    limits = in_display_units(names, joint_range.T)
    shown_targets, shown_angles = in_display_units(names, targets), in_display_units(names, angles)
    ends = time[[0, -1]]
    for j, name in enumerate(names):
        _series(stream, f"joints/{name}/angle", time, shown_angles[:, j], name)
        _series(stream, f"joints/{name}/target", time, shown_targets[:, j], f"{name} target")
        _series(stream, f"joints/{name}/min", ends, np.repeat(limits[0, j], 2), "lower limit")
        _series(stream, f"joints/{name}/max", ends, np.repeat(limits[1, j], 2), "upper limit")
        _series(stream, f"torques/{name}", time, torques[:, j], name)


def log_balance(stream: rr.RecordingStream, time: np.ndarray, torso_pose: np.ndarray, fsr: np.ndarray) -> None:
    """Log the torso's roll and pitch [degrees] and the load on each foot [N].

    Args:
        stream: an open recording.
        time: seconds on the recording's timeline, shape (n,).
        torso_pose: position [m] and quaternion (w, x, y, z) in the world frame, shape (n, 7).
        fsr: force sensor readings, left foot's four then right foot's four [N], shape (n, 8).
    """
    from scipy.spatial.transform import Rotation

    rotation = Rotation.from_quat(torso_pose[:, [4, 5, 6, 3]])
    _, pitch, roll = rotation.as_euler("ZYX", degrees=True).T
    _series(stream, "balance/torso_pitch", time, pitch, "torso pitch, forward +")
    _series(stream, "balance/torso_roll", time, roll, "torso roll, right side down +")
    _series(stream, "load/left_foot", time, fsr[:, :4].sum(axis=1), "left foot")
    _series(stream, "load/right_foot", time, fsr[:, 4:].sum(axis=1), "right foot")
