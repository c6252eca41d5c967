"""NAOqi scripts: a gesture for a real robot, as one ``ALMotion.angleInterpolation`` call.

The script stands alone: it needs ``qi`` and a robot, nothing of this package. It brings the robot to StandInit first,
because the motion was prepared for that stance.
"""

from __future__ import annotations

from pathlib import Path
from pprint import pformat

import numpy as np
from numpy.typing import NDArray

from nao_sim.gestures.formats.dense import write_whole
from nao_sim.motion.trajectory import Trajectory

# angleInterpolation joins its times linearly; so near, a 20 degree wave of 0.7 s is kept to a third of a degree.
_SPACING_S = 0.04
_STILL = 1e-4

_SCRIPT = '''"""{title} ({duration:.1f} s), for a NAO that stands free with space around it.

    python {file} 192.168.1.10

Written by nao-sim; angles in radians (hands: 0 closed, 1 open), times in seconds.
"""

import sys

import qi

NAMES = {names}
TIMES = {times}
KEYS = {keys}


def main(address):
    """Stand, then play the motion, on the robot at the address."""
    session = qi.Session()
    session.connect("tcp://" + address + ":9559")
    session.service("ALRobotPosture").goToPosture("StandInit", 0.5)
    session.service("ALMotion").angleInterpolation(NAMES, KEYS, TIMES, True)


if __name__ == "__main__":
    main(sys.argv[1])
'''


def write_naoqi_script(trajectory: Trajectory, path: str | Path) -> None:
    """Write a trajectory as a Python script for ``qi``; only the joints that move are in it."""
    path = Path(path)
    count = max(2, int(np.ceil(trajectory.duration / _SPACING_S)) + 1)
    # NAOqi refuses a first time of zero: the first key is where the robot should be one interval into the motion.
    times = np.linspace(0.0, trajectory.duration, count)[1:]
    keys = trajectory.sample(trajectory.times[0] + times)
    moving = [index for index, name in enumerate(trajectory.names) if np.ptp(trajectory.targets[:, index]) > _STILL]
    text = _SCRIPT.format(
        title=path.stem,
        duration=trajectory.duration,
        file=path.name,
        names=pformat([trajectory.names[index] for index in moving], width=110),
        times=_rows([times] * len(moving), 4),
        keys=_rows([keys[:, index] for index in moving], 4),
    )
    write_whole(path, text)


def _rows(rows: list[NDArray[np.float64]], digits: int) -> str:
    return "[\n" + "".join(f"    {[round(float(value), digits) for value in row]},\n" for row in rows) + "]"
