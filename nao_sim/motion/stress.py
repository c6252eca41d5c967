"""Does a motion survive robots and rooms that are not as documented, and what breaks it first?"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from nao_sim.motion.crowd import Outcome, play_all, replay
from nao_sim.motion.perform import MotionLog
from nao_sim.motion.players import Motion
from nao_sim.motion.trials import FACTORS, draw_trials
from nao_sim.robot import model_spec

# The search for the weakest factor: each alone, this many times its size, in this many trials.
SWEEP_SIZES = (2.0, 4.0, 8.0, 16.0)
SWEEP_TRIALS = 8
# Trials of one batch: enough to keep the cores busy, few enough that progress is seen.
_CHUNK = 250

Progress = Callable[[str, int, int | None], None]


@dataclass(frozen=True)
class StressReport:
    """The outcome of a stress test.

    Attributes:
        trials: how many; ``seed``: of all of them.
        upright_share: share that stayed up.
        fell: numbers of the trials that fell, and ``fell_at_s`` when.
        lean_deg: median and 95th percentile of each trial's greatest lean beyond the plan.
        breaking_size: factor → least multiple of its size at which half of the trials with that factor alone fall;
            None: not even at the largest. Empty when no sweep was asked for.
    """

    trials: int
    seed: int
    upright_share: float
    fell: tuple[int, ...]
    fell_at_s: tuple[float, ...]
    lean_deg: tuple[float, float]
    breaking_size: dict[str, float | None]

    @property
    def weakest(self) -> str | None:
        """The factor that breaks the motion first, or None when none does."""
        broken = {name: size for name, size in self.breaking_size.items() if size is not None}
        return min(broken, key=lambda name: broken[name]) if broken else None


def _nbody() -> int:
    return int(model_spec(fingers=False).compile().nbody)


def stress(
    motion: Motion,
    trials: int = 1000,
    seed: int = 0,
    *,
    sweep: bool = True,
    sizes: Mapping[str, float] | None = None,
    threads: int = 0,
    progress: Progress | None = None,
    limits: str = "thesis",
) -> StressReport:
    """Play a motion in many randomised trials.

    Args:
        motion: a trajectory or the plan of a walk.
        trials: how many.
        seed: trial k of a seed is always the same.
        sizes: factor → how far it may go, in multiples of its usual size; None: all at 1.
        sweep: also look for the factor that breaks the motion first.
        threads: 0 for all cores; the result does not depend on it.
        progress: called with (stage, done, total).
        limits: the range set that the robots keep: ``"thesis"``, ``"v5"`` or ``"envelope"``.
    """
    nbody = _nbody()
    outcomes = []
    for first in range(0, trials, _CHUNK):
        chosen = range(first, min(first + _CHUNK, trials))
        outcomes.append(play_all(motion, draw_trials(seed, chosen, nbody, sizes), threads=threads, limits=limits))
        if progress is not None:
            progress("trials", chosen.stop, trials)
    outcome = Outcome(*(np.concatenate([getattr(o, name) for o in outcomes]) for name in ("fell_at", "worst_lean")))
    fell = np.flatnonzero(~outcome.up)
    median, high = np.rad2deg(np.percentile(outcome.worst_lean, [50, 95]))
    return StressReport(
        trials=trials,
        seed=seed,
        upright_share=float(outcome.up.mean()),
        fell=tuple(int(index) for index in fell),
        fell_at_s=tuple(float(at) for at in outcome.fell_at[fell]),
        lean_deg=(float(median), float(high)),
        breaking_size=_sweep(motion, seed, nbody, threads, progress, limits) if sweep else {},
    )


def replay_trial(
    motion: Motion, seed: int, index: int, sizes: Mapping[str, float] | None = None, limits: str = "thesis"
) -> MotionLog:
    """Play one trial of a stress test again and return its log."""
    return replay(motion, draw_trials(seed, [index], _nbody(), sizes), limits)


def describe_trial(seed: int, index: int) -> dict[str, float | list[float]]:
    """Return the factors of one trial in units for people."""
    trial = draw_trials(seed, [index], _nbody())
    weak = trial.strength[0]
    return {
        "mass_factors": [round(float(trial.mass[0].min()), 3), round(float(trial.mass[0].max()), 3)],
        "torso_com_shift_mm": _rounded(1e3 * trial.com_m[0]),
        "friction": round(float(trial.friction[0]), 3),
        "motor_strength": [round(float(weak.min()), 3), round(float(weak.max()), 3)],
        "joint_play_deg": round(float(np.rad2deg(trial.play_rad[0])), 2),
        "delay_periods": int(trial.delay[0]),
        "slope_deg": _rounded(np.rad2deg(trial.slope_rad[0])),
        "initial_tilt_deg": _rounded(np.rad2deg(trial.tilt_rad[0])),
        "push_ns": _rounded(trial.push_ns[0]),
        "push_at_share": round(float(trial.push_at[0]), 3),
    }


def _rounded(values: Sequence[float] | np.ndarray) -> list[float]:
    return [round(float(value), 2) for value in values]


def _sweep(
    motion: Motion, seed: int, nbody: int, threads: int, progress: Progress | None, limits: str
) -> dict[str, float | None]:
    """Return each factor's breaking size; sizes grow until one factor breaks the motion, the rest are then stronger."""
    found: dict[str, float | None] = dict.fromkeys(FACTORS)
    for done, size in enumerate(SWEEP_SIZES):
        for factor in FACTORS:
            trials = draw_trials(seed, range(SWEEP_TRIALS), nbody, {factor: size})
            if play_all(motion, trials, threads=threads, limits=limits).up.mean() <= 0.5:
                found[factor] = size
        if progress is not None:
            progress("looking for the weakest factor", done + 1, len(SWEEP_SIZES))
        if any(found.values()):
            break
    return found
