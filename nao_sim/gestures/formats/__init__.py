"""The formats that NAO people have: Webots ``.motion``, NAOqi scripts, tables of joint angles."""

from __future__ import annotations

from pathlib import Path

from nao_sim.gestures.errors import GestureFileError
from nao_sim.gestures.formats.angle_table import read_csv, write_csv
from nao_sim.gestures.formats.naoqi_script import write_naoqi_script
from nao_sim.gestures.formats.webots_motion import read_webots_motion, write_webots_motion
from nao_sim.gestures.gesture import Gesture
from nao_sim.gestures.loader import load_toml_gesture
from nao_sim.motion.trajectory import Trajectory

READERS = {".toml": load_toml_gesture, ".motion": read_webots_motion, ".csv": read_csv}
WRITERS = {".motion": write_webots_motion, ".csv": write_csv, ".py": write_naoqi_script}

__all__ = [
    "READERS",
    "WRITERS",
    "load_gesture",
    "read_csv",
    "read_webots_motion",
    "save_trajectory",
    "write_csv",
    "write_naoqi_script",
    "write_webots_motion",
]


def load_gesture(path: str | Path, fit: bool = False) -> Gesture:
    """Read a gesture file; the suffix says its format.

    Args:
        path: ``.toml`` (own format), ``.motion`` (Webots) or ``.csv``.
        fit: leave angles outside their range for fitting to clip, instead of refusing them.

    Raises:
        GestureFileError: unknown suffix, or the file cannot be read as a gesture.
    """
    path = Path(path)
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise GestureFileError(path, f"unknown suffix '{path.suffix}'; known: {', '.join(READERS)}")
    return reader(path, fit)


def save_trajectory(trajectory: Trajectory, path: str | Path) -> None:
    """Write a trajectory for other programs; the suffix says the format.

    Args:
        trajectory: what the robot should do.
        path: ``.motion`` (Webots), ``.py`` (NAOqi script) or ``.csv``; replaced as a whole if it is there.

    Raises:
        GestureFileError: unknown suffix, or the place cannot be written.
    """
    path = Path(path)
    writer = WRITERS.get(path.suffix.lower())
    if writer is None:
        raise GestureFileError(path, f"unknown suffix '{path.suffix}'; known: {', '.join(WRITERS)}")
    writer(trajectory, path)
