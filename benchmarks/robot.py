"""How fast the robot runs: ``python benchmarks/robot.py`` (a quiet machine; ratios hold on a busy one too).

Loops with the same commands, standing with moving arms, in turns:

* bare: ``mj_step`` and nothing else, controls written straight to the motors;
* nao: the same through ``Nao``: limit checks, anti-collision tables, set-point profile, fall check, a log of targets,
  angles, velocities, torques, torso pose and foot forces every 20 ms;
* stand-in: the same tree of links as anybody would put it together: position servos, steps of 1/240 s, MuJoCo's own
  solver settings, one box a sole, no shells, sensors or coupled joints. What a good figure is on this machine;
* camera: 640x480 pictures, arms hanging and arms raised into the picture.

Three robots: as it comes, with rigid fingers, and with neither moving fingers nor shells, which no physics needs.
Speeds are simulated steps of 1/240 s per second of this thread's processor time (camera: wall time), whatever the
model's own step is.
"""

from __future__ import annotations

import argparse
import json
import time

import numpy as np

from nao_sim.robot import CHAINS, CONTROL_PERIOD_S, Nao, model_spec, posture
from nao_sim.robot.placement import place  # before mujoco: importing nao_sim chooses how it renders

import mujoco  # isort: skip

PERIODS, ROUNDS = 250, 15
REFERENCE_STEP_S = 1 / 240
STANDING_CONTACTS = 8


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


def bare(model: mujoco.MjModel, data: mujoco.MjData, setpoints: np.ndarray) -> float:
    """Time ``mj_step`` alone over recorded set-points."""
    substeps = round(CONTROL_PERIOD_S / model.opt.timestep)
    place(model, data, posture("StandInit"))
    start = time.thread_time()
    for setpoint in setpoints:
        data.ctrl[:] = setpoint
        for _ in range(substeps):
            mujoco.mj_step(model, data)
    return steps_per_second(len(setpoints) * substeps, model.opt.timestep, time.thread_time() - start)


def stand_in() -> mujoco.MjModel:
    """Compile the robot's links with plain position servos and default settings."""
    spec = model_spec(fingers=False, shells=False)
    default = mujoco.MjSpec().option
    spec.option.timestep, spec.option.disableflags = REFERENCE_STEP_S, default.disableflags
    for element in [*spec.sensors, *spec.equalities, *(site for site in spec.sites if not site.name.endswith("_sole"))]:
        spec.delete(element)
    for actuator in spec.actuators:
        leg = actuator.name[1:].startswith(("Hip", "Knee", "Ankle"))
        actuator.set_to_position(kp=300 if leg else 60, kv=6 if leg else 1.2)
    return spec.compile()


def full(nao: Nao, targets: np.ndarray, log: np.ndarray) -> float:
    """Time the robot's own interface, with its checks and a log."""
    nao.reset("StandInit")
    joints = CHAINS["Arms"]
    start = time.thread_time()
    for row, target in zip(log, targets, strict=True):
        nao.set_angles(joints, target)
        nao.step()
        measured = (nao.targets, nao.angles, nao.velocities, nao.torques, nao.torso_pose, nao.fsr)
        np.concatenate(measured, out=row[:-1])
        row[-1] = nao.fallen
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


def pictures_per_second(nao: Nao, count: int = 30) -> float:
    """Time the head's camera at its documented size; the best round."""
    nao.camera("CameraTop")
    best = 0.0
    for _ in range(ROUNDS):
        start = time.perf_counter()
        for _ in range(count):
            nao.camera("CameraTop")
        best = max(best, count / (time.perf_counter() - start))
    return best


def measure(fingers: bool, shells: bool, plain: mujoco.MjModel) -> dict[str, float]:
    """Run the loops in turns; best rounds, and the median of the ratios."""
    nao = Nao(fingers=fingers, shells=shells)
    targets = commands(PERIODS)
    setpoints, log = record(nao, targets), np.zeros((PERIODS, 116))
    rounds, plain_data = [], mujoco.MjData(plain)
    for _ in range(ROUNDS):
        own = bare(nao.model, nao.data, setpoints), full(nao, targets, log)
        rounds.append((*own, bare(plain, plain_data, setpoints)))
    if log[:, -1].any() or plain_data.ncon != STANDING_CONTACTS:
        raise SystemExit("the robot fell: the figures would mean nothing")
    own_bare, whole, other = np.array(rounds).T
    return {
        "bare_steps_s": float(own_bare.max()),
        "nao_steps_s": float(whole.max()),
        "stand_in_steps_s": float(other.max()),
        "nao_over_bare": float(np.median(whole / own_bare)),
        "nao_over_stand_in": float(np.median(whole / other)),
    }


def camera() -> dict[str, float]:
    """Time pictures without and with the robot's own arms in them."""
    with Nao() as nao:
        hanging = pictures_per_second(nao)
        nao.set_angles("LArm", [-0.3, 0.0, -1.2, -0.6, 0.0, 1.0])
        nao.set_angles("RArm", [-0.3, 0.0, 1.2, 0.6, 0.0, 1.0])
        nao.step(100)
        return {"arms_hanging_fps": hanging, "arms_in_view_fps": pictures_per_second(nao)}


def main() -> None:
    """Measure and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--json", action="store_true")
    parser.add_argument("--no-camera", action="store_true", help="leave the camera out")
    arguments = parser.parse_args()
    plain = stand_in()
    robots = {"as it comes": (True, True), "rigid fingers": (False, True), "rigid fingers, no shells": (False, False)}
    result = {name: measure(fingers, shells, plain) for name, (fingers, shells) in robots.items()}
    if not arguments.no_camera:
        result["camera"] = camera()
    if arguments.json:
        print(json.dumps(result, indent=2))
        return
    for name, values in result.items():
        shown = (f"{key} {value:,.0f}" if value > 10 else f"{key} {100 * value:.0f} %" for key, value in values.items())
        print(f"{name}: {', '.join(shown)}")


if __name__ == "__main__":
    main()
