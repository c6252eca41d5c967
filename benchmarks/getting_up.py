"""Share of falls after which the robot stands again, by direction, over random friction, mass and falls.

    python benchmarks/getting_up.py --trials 20 --seed 1

Each trial knocks the standing robot over with a push of 9 N·s, waits until it lies, and then calls ``get_up``.
A trial counts as first-time when the second attempt was not needed.
"""

from __future__ import annotations

import argparse

import mujoco
import numpy as np

from nao_sim.motion.getting_up import Lie, get_up, lie_of
from nao_sim.robot import Nao

FRICTION, MASS_SHARE, STRENGTH_SHARE = (0.4, 1.0), 0.10, 0.15


def knock_over(nao: Nao, rng: np.random.Generator, towards: Lie) -> None:
    """Push the robot over its toes or heels, up to 20 degrees off straight, and let it lie down."""
    angle = rng.uniform(-0.35, 0.35) + (0.0 if towards is Lie.BELLY else np.pi)
    torso = nao.model.body("torso").id
    for _ in range(15):
        nao.data.xfrc_applied[torso, :2] = 30.0 * np.array([np.cos(angle), np.sin(angle)])
        nao.step()
    nao.data.xfrc_applied[:] = 0
    nao.step(100)


def vary(nao: Nao, rng: np.random.Generator) -> tuple[float, float, float]:
    model = nao.model
    friction = rng.uniform(*FRICTION)
    mass = rng.uniform(1 - MASS_SHARE, 1 + MASS_SHARE)
    strength = rng.uniform(1 - STRENGTH_SHARE, 1 + STRENGTH_SHARE)
    model.geom_friction[:, 0] = friction
    model.body_mass[:] *= mass
    model.body_inertia[:] *= mass
    model.actuator_gainprm[:, 0] /= strength
    model.actuator_forcerange[:] *= strength
    mujoco.mj_setConst(model, nao.data)
    nao.reset()
    return friction, mass, strength


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--trials", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--sides", nargs="*", default=["belly", "back"], choices=["belly", "back"])
    parser.add_argument("--verbose", action="store_true")
    args = parser.parse_args()
    for side in args.sides:
        stood = first = 0
        for trial in range(args.trials):
            rng = np.random.default_rng([args.seed, trial])
            nao = Nao(fingers=False)
            facts = vary(nao, rng)
            knock_over(nao, rng, Lie(side))
            lies = lie_of(nao.torso_pose[3:])
            log = get_up(nao)
            stood += not log.fallen
            first += not log.fallen and log.time[-1] < 18.0
            if args.verbose:
                mark = "stands" if not log.fallen else "LIES"
                print(
                    f"  {trial}: on its {lies.value}, friction {facts[0]:.2f} mass {facts[1]:.2f} "
                    f"strength {facts[2]:.2f}: {mark} after {log.time[-1]:.1f} s",
                    flush=True,
                )
        print(f"{side:6s} stands {stood} / {args.trials}, at the first attempt {first}", flush=True)


if __name__ == "__main__":
    main()
