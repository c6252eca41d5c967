"""NAOqi scripts: a motion for a real robot, as one ``ALMotion.angleInterpolation`` call.

The script stands alone: it needs ``qi`` and a robot, nothing of this package. It brings the robot to StandInit first,
because motions are prepared for that stance.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from pprint import pformat

import numpy as np

from nao_sim.gestures.formats.text_file import write_whole
from nao_sim.motion.curves import Curve
from nao_sim.motion.trajectory import CONTROL_PERIOD

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


def write(curves: Mapping[str, Curve], path: Path) -> list[str]:
    """Write a motion as a Python script for ``qi``; sampled joints that do not move are left out."""
    straight = {name: curve.straight(_SPACING_S) for name, curve in curves.items()}
    kept = {name: _thinned(curve) for name, curve in straight.items() if len(curve.times) < 3 or _moves(curve)}
    dense = min(len(curve.times) for curve in curves.values()) > 2
    kept = {name: _after_zero(curve, dense) for name, curve in kept.items()}
    duration = max((float(curve.times[-1]) for curve in kept.values()), default=0.0)
    text = _SCRIPT.format(
        title=path.stem,
        duration=duration,
        file=path.name,
        names=pformat(list(kept), width=110),
        times=_rows([curve.times.tolist() for curve in kept.values()]),
        keys=_rows([curve.values.tolist() for curve in kept.values()]),
    )
    write_whole(path, text)
    at_zero = any(curve.times[0] <= 0 for curve in curves.values())
    return ["a pose at 0 s is 20 ms later there: NAOqi takes no key at 0"] if at_zero and not dense else []


def _after_zero(curve: Curve, dense: bool) -> Curve:
    """Return the keys without one at zero, which NAOqi refuses."""
    if curve.times[0] > 0:
        return curve
    if dense and len(curve.times) > 1:
        # The first key is then where the robot should be one interval into the motion.
        return Curve(curve.times[1:], curve.values[1:])
    return Curve(np.maximum(curve.times, CONTROL_PERIOD), curve.values)


def _moves(curve: Curve) -> bool:
    return float(np.ptp(curve.values)) > _STILL


def _thinned(curve: Curve) -> Curve:
    """Return a curve with no more keys than one each 40 ms."""
    length = float(curve.times[-1] - curve.times[0])
    count = max(2, int(np.ceil(length / _SPACING_S)) + 1)
    if len(curve.times) <= count:
        return curve
    times = np.linspace(curve.times[0], curve.times[-1], count)
    return Curve(times, np.interp(times, curve.times, curve.values))


def _rows(rows: list[list[float]]) -> str:
    return "[\n" + "".join(f"    {[round(value, 5) for value in row]},\n" for row in rows) + "]"
