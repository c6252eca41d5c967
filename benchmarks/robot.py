"""How fast the robot runs: ``python benchmarks/robot.py`` (a quiet machine; ratios hold on a busy one too).

Three loops over the same model and the same commands, standing with moving arms, in turns:

* bare: ``mj_step`` and nothing else, controls written straight to the motors;
* nao: the same through ``Nao``: limit checks, anti-collision tables, set-point profile, fall check, a log of targets,
  angles, velocities, torques, torso pose and foot forces every 20 ms;
* camera: 640x480 pictures from ``CameraTop``.

Speeds are simulated steps of 1/240 s per second of this thread's processor time (camera: wall time).
"""

from __future__ import annotations

import argparse
import json
import time

import numpy as np

from nao_sim.robot import CHAINS, Nao

PERIODS, ROUNDS = 500, 7
REFERENCE_STEP_S = 1 / 240


def commands(periods: int) -> np.ndarray:
    """Return ``(periods, 12)`` targets of both arms: waving, as fast as the motors go."""
    phase = np.arange(periods) * 0.02 * 2 * np.pi
    arm = [
        -0.4 + 0.5 * np.sin(phase),
        0.5 + 0.2 * np.cos(phase),
        1.0 * np.ones(periods),
        0.8 + 0.5 * np.sin(2 * phase),
        0.3 * np.sin(phase),
        0.5 + 0.5 * np.sin(phase),
    ]
    left = np.column_stack([arm[0], arm[1], -arm[2], -arm[3], arm[4], arm[5]])
    right = np.column_stack([arm[0], -arm[1], arm[2], arm[3], -arm[4], arm[5]])
    return np.hstack([left, right])


def steps_per_second(steps: int, timestep: float, seconds: float) -> float:
    """Turn a measured time into steps of 1/240 s a second."""
    return steps * timestep / REFERENCE_STEP_S / seconds


def bare(nao: Nao, setpoints: np.ndarray) -> float:
    """Time ``mj_step`` alone over recorded set-points."""
    import mujoco  # after nao_sim, which chooses how it renders

    nao.reset("StandInit")
    model, data, substeps = nao.model, nao.data, round(nao.control_period / nao.model.opt.timestep)
    start = time.thread_time()
    for setpoint in setpoints:
        data.ctrl[:] = setpoint
        for _ in range(substeps):
            mujoco.mj_step(model, data)
    return steps_per_second(len(setpoints) * substeps, model.opt.timestep, time.thread_time() - start)


def full(nao: Nao, targets: np.ndarray, log: np.ndarray) -> float:
    """Time the robot's own interface, with its checks and a log."""
    nao.reset("StandInit")
    joints = CHAINS["Arms"]
    start = time.thread_time()
    for row, target in zip(log, targets, strict=True):
        nao.set_angles(joints, target)
        nao.step()
        row[:25], row[25:50] = nao.targets, nao.angles
        row[50:75], row[75:100] = nao.velocities, nao.torques
        row[100:107], row[107:115], row[115] = nao.torso_pose, nao.fsr, nao.fallen
    seconds = time.thread_time() - start
    steps = len(targets) * round(nao.control_period / nao.model.opt.timestep)
    return steps_per_second(steps, nao.model.opt.timestep, seconds)


def record(nao: Nao, targets: np.ndarray) -> np.ndarray:
    """Return the set-points those commands lead to."""
    nao.reset("StandInit")
    setpoints = []
    for target in targets:
        nao.set_angles(CHAINS["Arms"], target)
        nao.step()
        setpoints.append(nao.setpoint)
    return np.array(setpoints)


def pictures_per_second(nao: Nao, count: int = 60) -> float:
    """Time the head's camera at its documented size."""
    nao.camera("CameraTop")
    start = time.perf_counter()
    for _ in range(count):
        nao.camera("CameraTop")
    return count / (time.perf_counter() - start)


def measure(fingers: bool) -> dict[str, float]:
    """Run the two loops in turns and return the medians."""
    nao = Nao(fingers=fingers)
    targets = commands(PERIODS)
    setpoints, log = record(nao, targets), np.zeros((PERIODS, 116))
    rounds = [(bare(nao, setpoints), full(nao, targets, log)) for _ in range(ROUNDS)]
    if log[:, 115].any():
        raise SystemExit("the robot fell: the figures would mean nothing")
    plain, whole = np.array(rounds).T
    return {
        "bare_steps_s": float(np.median(plain)),
        "nao_steps_s": float(np.median(whole)),
        "best_bare_steps_s": float(plain.max()),
        "best_nao_steps_s": float(whole.max()),
        "ratio": float(np.median(whole / plain)),
    }


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--no-camera", action="store_true", help="leave the camera out")
    arguments = parser.parse_args()
    result: dict[str, object] = {f"fingers_{name}": measure(name == "moving") for name in ("moving", "rigid")}
    if not arguments.no_camera:
        with Nao() as nao:
            result["camera_fps"] = pictures_per_second(nao)
    if arguments.json:
        print(json.dumps(result, indent=2))
        return
    for name, values in result.items():
        if isinstance(values, dict):
            figures = (values["bare_steps_s"], values["nao_steps_s"], 100 * values["ratio"])
            print(f"{name}: bare {figures[0]:,.0f} steps/s, through Nao {figures[1]:,.0f}, ratio {figures[2]:.0f} %")
        else:
            print(f"{name}: {values:.0f}")


if __name__ == "__main__":
    main()
