"""pytest plugin of nao-sim: motion files become tests of the joint limits, and two fixtures for tests of one's own.

Nothing happens, and nothing of nao-sim is imported, unless ``--nao-limits`` or the ini options ``nao_motions`` or
``nao_limits`` ask for it or a test uses a fixture. ``docs/validation.md`` shows it at work.
"""

from __future__ import annotations

import fnmatch
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest

if TYPE_CHECKING:
    from nao_sim.gestures.formats import Said
    from nao_sim.robot import Nao

_DEFAULT_LIMITS = "thesis"


def pytest_addoption(parser: pytest.Parser) -> None:
    """Add the options; each has an ini option of the same meaning."""
    group = parser.getgroup("nao-sim", "joint limits of NAO motion files (nao-sim)")
    group.addoption(
        "--nao-limits", metavar="SET", help="Test motion files: thesis, v5 or envelope; several with commas."
    )
    group.addoption("--nao-play", action="store_true", help="Also play each on the simulated robot: balance, tracking.")
    group.addoption("--nao-units", metavar="UNITS", help="What tables do not say: as nao-sim --units, e.g. 'rad,ms'.")
    group.addoption("--nao-longest", metavar="SECONDS", type=float, help="How long a motion may last.")
    parser.addini(
        "nao_motions", "Patterns of motion files, relative to the root; all motion files by default.", "linelist"
    )
    parser.addini("nao_limits", "Range set or sets to test motion files against.", default="")
    parser.addini("nao_play", "Also play each on the simulated robot.", "bool", default=False)
    parser.addini("nao_units", "What tables do not say.", default="")
    parser.addini("nao_longest", "Seconds that a motion may last.", default="")


def pytest_configure(config: pytest.Config) -> None:
    """Refuse an unknown range set before anything runs."""
    if config.getoption("--nao-limits") or config.getini("nao_limits"):
        _limit_sets(config)


def pytest_collect_file(file_path: Path, parent: pytest.Collector) -> pytest.Collector | None:
    """Make a collector of a motion file, if motion files were asked for."""
    config = parent.config
    patterns: list[str] = config.getini("nao_motions")
    if not patterns and not config.getoption("--nao-limits") and not config.getini("nao_limits"):
        return None
    if patterns and not parent.session.isinitpath(file_path):
        place = file_path.relative_to(config.rootpath).as_posix() if file_path.is_relative_to(config.rootpath) else ""
        if not any(fnmatch.fnmatch(place, pattern) or fnmatch.fnmatch(file_path.name, pattern) for pattern in patterns):
            return None
    from nao_sim.gestures.formats import SUFFIXES, holds_a_motion

    if file_path.suffix.lower() not in SUFFIXES or not (patterns or holds_a_motion(file_path)):
        return None
    if file_path.suffix == ".py" and not holds_a_motion(file_path):
        return None
    made: pytest.Collector = MotionFile.from_parent(parent, path=file_path)
    return made


class LimitsExceeded(AssertionError):
    """A motion that leaves its ranges, outruns its motors, or does not stand; one line each."""


class MotionFile(pytest.File):
    """A motion file; a test for each range set."""

    def collect(self) -> Iterator[pytest.Item]:
        """Yield the tests."""
        for limits in _limit_sets(self.config):
            yield MotionItem.from_parent(self, name=limits)


class MotionItem(pytest.Item):
    """One motion file and one range set."""

    def runtest(self) -> None:
        """Hold the motion to the limits; play it, if that was asked for."""
        from nao_sim.gestures.validation import limits_kept, validate_gesture

        said = _said(self.config)
        if self.config.getoption("--nao-play") or self.config.getini("nao_play"):
            lines = validate_gesture(self.path, self.name, said=said).faults
        else:
            lines = [str(entry) for entry in limits_kept(self.path, self.name, said)]
        if lines:
            raise LimitsExceeded("\n".join(lines))

    def repr_failure(self, excinfo: pytest.ExceptionInfo[BaseException], style: Any = None) -> Any:
        """Return one line a violation, and one line for a file that cannot be read."""
        from nao_sim.errors import NaoSimError

        if excinfo.errisinstance((LimitsExceeded, NaoSimError, OSError)):
            return str(excinfo.value)
        return super().repr_failure(excinfo, style)

    def reportinfo(self) -> tuple[Path, None, str]:
        """Return how reports call it."""
        return self.path, None, f"{self.path.name} within '{self.name}' limits"


@pytest.fixture
def nao(request: pytest.FixtureRequest) -> Iterator[Nao]:
    """A simulated NAO, standing, with the limits of ``--nao-limits`` (or the ini option ``nao_limits``)."""
    from nao_sim import Nao

    with Nao(limits=_limit_sets(request.config)[0]) as robot:
        yield robot


@pytest.fixture
def assert_within_limits(request: pytest.FixtureRequest) -> Callable[..., None]:
    """A function that fails unless a motion keeps its joints' ranges and motors: ``check(motion, limits="v5")``.

    A motion is a trajectory, a gesture, a log (what was measured is held to the limits), the name of a library gesture,
    a motion file, or ``(times, {joint: angles})`` in seconds and radians.
    """

    def check(motion: Any, limits: str | None = None) -> None:
        __tracebackhide__ = True
        lines = [str(entry) for entry in _violations(motion, limits or _limit_sets(request.config)[0], request.config)]
        if lines:
            raise LimitsExceeded("\n".join(lines))

    return check


def _violations(motion: Any, limits: str, config: pytest.Config) -> Iterable[object]:
    import numpy as np

    from nao_sim.gestures import Gesture, written
    from nao_sim.gestures.validation import limits_kept
    from nao_sim.motion import MotionLog, Trajectory
    from nao_sim.motion.curves import Curve
    from nao_sim.motion.violations import angle_violations, violations

    if isinstance(motion, (str, Path)):
        return limits_kept(motion, limits, _said(config))
    if isinstance(motion, MotionLog):
        # Measured speeds are the motors' own and may pass the nominal ones: with a load behind them joints run ahead.
        return angle_violations(Trajectory(motion.time, motion.angles), limits)
    if isinstance(motion, Gesture):
        return violations(written(motion), limits)
    if isinstance(motion, Trajectory):
        return violations(motion, limits)
    times, angles = motion
    at = np.asarray(times, dtype=float)
    return violations({name: Curve(at, np.asarray(values, dtype=float)) for name, values in angles.items()}, limits)


def _limit_sets(config: pytest.Config) -> list[str]:
    asked = config.getoption("--nao-limits") or config.getini("nao_limits") or _DEFAULT_LIMITS
    sets = [name.strip() for name in asked.split(",") if name.strip()]
    from nao_sim.robot.joints import LIMITS

    for name in sets:
        if name not in LIMITS:
            raise pytest.UsageError(f"--nao-limits: no range set '{name}'; known: {', '.join(LIMITS)}")
    return sets


def _said(config: pytest.Config) -> Said:
    from nao_sim.gestures.formats import said

    longest = config.getoption("--nao-longest") or config.getini("nao_longest")
    units = config.getoption("--nao-units") or config.getini("nao_units")
    return said(units or None, float(longest) if longest else None)
