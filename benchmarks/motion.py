"""How fast gestures are prepared, performed, stressed, and stepped as an environment.

Processor time, so that a busy machine does not count; ratios are measured side by side in one run.

    python benchmarks/motion.py
"""

from __future__ import annotations

import time

import mujoco
import numpy as np

from nao_sim.environment import track
from nao_sim.gestures import library
from nao_sim.motion import perform
from nao_sim.motion.crowd import play_all
from nao_sim.motion.trials import draw_trials
from nao_sim.robot import Nao

ROUNDS = 15


def main():
    gesture = library()["bye_right"]
    begun = time.process_time()
    trajectory = gesture.trajectory()
    print(f"prepare {gesture.name} ({trajectory.duration:.1f} s): {time.process_time() - begun:.2f} s")
    nao, environment = Nao(), track("bye_right")
    targets = trajectory.sample(np.arange(1, 200) * 0.02)

    def bare():
        nao.reset()
        begun = time.process_time()
        for row in targets:
            nao.data.ctrl[:] = row
            mujoco.mj_step(nao.model, nao.data, 5)
        return time.process_time() - begun

    def loop():
        nao.reset()
        begun = time.process_time()
        for row in targets:
            nao.set_targets(row)
            nao.step()
        return time.process_time() - begun

    def learner():
        environment.reset()
        begun = time.process_time()
        for row in targets:
            environment.step(row)
        return time.process_time() - begun

    def performed():
        nao.reset()
        begun = time.process_time()
        log = perform(nao, trajectory)
        return (time.process_time() - begun) * len(targets) / (len(log.time) - 1)

    seconds = np.array([[bare(), loop(), learner(), performed()] for _ in range(ROUNDS)]) / len(targets)
    for name, column in zip(("bare mj_step", "Nao loop", "environment", "perform"), seconds.T, strict=True):
        print(f"{name:14s} {1e6 * np.median(column):6.0f} us a control period")
    print(f"environment over Nao loop: {np.median(seconds[:, 2] / seconds[:, 1]):.2f}")
    print(f"environment over bare mj_step: {np.median(seconds[:, 2] / seconds[:, 0]):.2f}")
    trials = draw_trials(0, range(100), Nao(fingers=False).model.nbody)
    begun = time.process_time()
    play_all(trajectory, trials, threads=1)
    spent = time.process_time() - begun
    scaled = 10 * spent * 4.0 / trajectory.duration
    print(f"1,000 trials of 4 s: {scaled:.0f} s of one core")


if __name__ == "__main__":
    main()
