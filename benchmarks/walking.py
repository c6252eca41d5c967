"""Share of walks that stay up under random mass, friction, motors, tilt, slope, play, delay and a push.

    python benchmarks/walking.py --trials 100 --seed 1

Every trial differs in all factors of ``nao_sim.motion.trials`` at once; ``--size`` scales how far they may go.
"""

from __future__ import annotations

import argparse
import dataclasses

import numpy as np

from nao_sim.motion.crowd import Crowd
from nao_sim.motion.trials import FACTORS, draw_trials
from nao_sim.motion.walking import Observation, WalkController, plan_walk
from nao_sim.motion.walking.gait import WalkSettings, walk_settings
from nao_sim.robot import Nao

WALKS = {
    "left": (0.0, 0.35, 0.0),
    "right": (0.0, -0.35, 0.0),
    "forward": (0.30, 0.0, 0.0),
    "backward": (-0.30, 0.0, 0.0),
    "turn": (0.0, 0.0, np.pi / 2),
    "arc": (0.20, 0.10, 0.5),
}
SETTLE_PERIODS = 50


def yaw_of(quat: np.ndarray) -> np.ndarray:
    w, x, y, z = np.moveaxis(quat, -1, 0)
    return np.arctan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z))


def run(
    goal: tuple[float, float, float],
    indices: range,
    seed: int,
    sizes: dict[str, float],
    settings: WalkSettings | None = None,
) -> tuple[np.ndarray, np.ndarray]:
    """Return which trials stayed up ``(n,)``, and where their torsos ended against the start ``(n, 3)``: x, y, yaw."""
    with Nao(fingers=False) as nao:
        nbody = nao.model.nbody
    crowd = Crowd(draw_trials(seed, indices, nbody, sizes))
    controller = WalkController(plan_walk(*goal), settings)
    pose = crowd.batch.bind("xpos")[:, crowd.torso, :2].copy()
    steps = len(controller.plan.times) + SETTLE_PERIODS
    up = np.ones(len(indices), bool)
    for step in range(steps):
        crowd.push(step / steps, steps * 0.02)
        crowd.step(controller.targets(Observation(crowd.lean(), crowd.rate())))
        up &= ~crowd.down()
    moved = crowd.batch.bind("xpos")[:, crowd.torso, :2] - pose
    return up, np.column_stack([moved, yaw_of(crowd.batch.bind("xquat")[:, crowd.torso])])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=100)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--size", type=float, default=1.0, help="multiple of every factor's documented spread")
    parser.add_argument("--push", type=float, default=None, help="push alone, as a multiple of 0.3 N·s")
    parser.add_argument("--gain", nargs=2, action="append", default=[], metavar=("NAME", "VALUE"))
    parser.add_argument("--walks", nargs="*", default=list(WALKS), choices=list(WALKS))
    parser.add_argument("--only", nargs="*", default=list(FACTORS), choices=list(FACTORS))
    args = parser.parse_args()
    sizes = dict.fromkeys(args.only, args.size)
    if args.push is not None:
        sizes["push"] = args.push
    settings = walk_settings()
    gains = dataclasses.replace(settings.gains, **{name: float(value) for name, value in args.gain})
    settings = dataclasses.replace(settings, gains=gains)
    for name in args.walks:
        up, end = run(WALKS[name], range(args.trials), args.seed, sizes, settings)
        mean, spread = end[up].mean(axis=0), end[up].std(axis=0)
        print(
            f"{name:9s} up {up.sum():4d} / {len(up)}   ended at x {mean[0]:+.3f} ± {spread[0]:.3f} m, "
            f"y {mean[1]:+.3f} ± {spread[1]:.3f} m, yaw {np.degrees(mean[2]):+.1f} ± {np.degrees(spread[2]):.1f}°",
            flush=True,
        )


if __name__ == "__main__":
    main()
