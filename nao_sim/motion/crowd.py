"""One motion on many robots at once, each in its own trial, on all cores (``mujoco.batch``)."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import mujoco
import numpy as np
from mujoco.batch import Batch
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from nao_sim.motion.balance import Gains, lean_of
from nao_sim.motion.perform import MotionLog
from nao_sim.motion.players import Motion, Player, player_of
from nao_sim.motion.trajectory import CONTROL_PERIOD
from nao_sim.motion.trials import Trials
from nao_sim.motion.whole_body import LEG_JOINTS
from nao_sim.robot import ACTUATED, Nao, joint_table
from nao_sim.robot.anti_collision import pair_tables
from nao_sim.robot.command import CommandLayer
from nao_sim.robot.sensors import FSR

Array = NDArray[np.float64]

_BAD_STATE = slice(int(mujoco.mjtWarning.mjWARN_BADQPOS), int(mujoco.mjtWarning.mjWARN_BADQACC) + 1)
_PUSH_S = 0.04  # a push takes so long
# Down: the torso leans beyond 85 degrees, or is lower than any motion on the feet brings it.
_DOWN_COS, _DOWN_HEIGHT_M = np.cos(np.deg2rad(85.0)), 0.17
_LEG_COLUMNS = [ACTUATED.index(name) for name in LEG_JOINTS]
# An edge of a sole is at most so far from its middle; a tilted robot is lifted by what that edge would sink in.
_SOLE_REACH_M = 0.12


@dataclass(frozen=True, eq=False)
class Outcome:
    """What became of n trials: when each fell (s, NaN: it stayed up), and its greatest lean beyond the plan (rad).

    A trial whose simulation became unstable counts as fallen when it did.
    """

    fell_at: Array
    worst_lean: Array

    @property
    def up(self) -> NDArray[np.bool_]:
        """Which trials stayed up, shape (n,)."""
        return np.isnan(self.fell_at)


class Crowd:
    """The robots of some trials.

    Args:
        trials: one robot each.
        threads: of the batch; 0 for all cores.
        limits: the range set that the robots keep.
    """

    def __init__(self, trials: Trials, threads: int = 0, limits: str = "thesis") -> None:
        with Nao(limits, fingers=False, shells=False) as nao:
            self.model, start = nao.model, nao.data.qpos.copy()
        self.trials = trials
        self.batch = Batch(self.model, len(trials), threads)
        self.torso = self.model.body("torso").id
        self._qpos = [self.model.joint(name).qposadr[0] for name in ACTUATED]
        self._set_models()
        self._place(start)
        table = joint_table().select(ACTUATED)
        self._low, self._high = table.range_rad(limits).T
        self._layer = CommandLayer(limits, CONTROL_PERIOD)
        self._setpoint = np.tile(start[self._qpos], (len(trials), 1))
        self._travel = np.zeros_like(self._setpoint)
        self._felt = self._setpoint.copy()
        self._queue = np.repeat(self._setpoint[:, None], int(trials.delay.max(initial=0)) + 1, axis=1)
        self.batch.ctrl = self._setpoint
        self._quat, self._place_now = self.batch.bind("xquat"), self.batch.bind("xpos")
        gyro = self.model.sensor("Gyrometer").adr[0]
        self._gyro = self.batch.bind("sensordata")[:, gyro : gyro + 2]
        self.batch.forward()

    def _set_models(self) -> None:
        trials, batch = self.trials, self.batch
        batch.expand("body_mass")[:] *= trials.mass
        batch.expand("body_inertia")[:] *= trials.mass[:, :, None]
        batch.expand("body_ipos")[:, self.torso] += trials.com_m
        batch.expand("geom_friction")[:, :, 0] = trials.friction[:, None]
        # A motor's resistance sets its stall torque and leaves its no-load speed alone.
        batch.expand("actuator_gainprm")[:, :, 0] /= trials.strength
        batch.expand("actuator_forcerange")[:] *= trials.strength[:, :, None]
        slope = _turn(trials.slope_rad)
        batch.expand("geom_quat")[:, self.model.geom("floor").id] = slope.as_quat(scalar_first=True)
        batch.set_const()

    def _place(self, start: Array) -> None:
        trials, qpos = self.trials, self.batch.bind("qpos")
        qpos[:] = start
        slope, tilt = _turn(trials.slope_rad), _turn(trials.tilt_rad)
        lift = _SOLE_REACH_M * np.sin(np.abs(trials.tilt_rad)).sum(axis=1)
        place = tilt.apply(start[:3]) + lift[:, None] * np.array([0.0, 0.0, 1.0])
        qpos[:, :3] = slope.apply(place)
        upright = Rotation.from_quat(start[3:7], scalar_first=True)
        qpos[:, 3:7] = (slope * tilt * upright).as_quat(scalar_first=True)

    def lean(self) -> Array:
        """Return each torso's roll and pitch against gravity, rad, shape (n, 2)."""
        return lean_of(self._quat[:, self.torso])

    def rate(self) -> Array:
        """Return each gyrometer's x and y, rad/s, shape (n, 2)."""
        return self._gyro

    def lost(self) -> NDArray[np.bool_]:
        """Return whose simulation has become unstable, shape (n,).

        MuJoCo sets such a one back to its start, where it stands and goes on; only its warnings tell.
        """
        return self.batch.warning[:, _BAD_STATE, 1].any(axis=1)

    def down(self) -> NDArray[np.bool_]:
        """Return which robots are down, or lost, shape (n,)."""
        quat = self._quat[:, self.torso]
        upright = 1 - 2 * (quat[:, 1] ** 2 + quat[:, 2] ** 2)
        return (upright < _DOWN_COS) | (self._place_now[:, self.torso, 2] < _DOWN_HEIGHT_M) | self.lost()

    def push(self, share: float, duration: float) -> None:
        """Apply the pushes that are on at this share of a motion of this many seconds."""
        on = (self.trials.push_at <= share) & (share < self.trials.push_at + _PUSH_S / duration)
        self.batch.bind("xfrc_applied")[:, self.torso, :2] = on[:, None] * self.trials.push_ns / _PUSH_S

    def step(self, commands: Array) -> None:
        """Send a set-point to each robot, shape (n, 25), and advance one control period."""
        wanted = _clamp_pairs(np.clip(commands, self._low, self._high))
        before, (glided, _) = self._setpoint, self._layer.glide(self._setpoint, wanted, self._travel)
        self._setpoint = _clamp_pairs(glided)
        self._travel = np.abs(self._setpoint - before)
        self._queue = np.roll(self._queue, 1, axis=1)
        self._queue[:, 0] = self._setpoint
        late = self._queue[np.arange(len(self.trials)), self.trials.delay].copy()
        half = self.trials.play_rad[:, None] / 2
        # Play: the joint stays where it is until the gear has crossed the gap.
        legs = late[:, _LEG_COLUMNS]
        late[:, _LEG_COLUMNS] = np.clip(self._felt[:, _LEG_COLUMNS], legs - half, legs + half)
        substeps = round(CONTROL_PERIOD / self.model.opt.timestep)
        ctrl, change, last = self.batch.bind("ctrl"), late - self._felt, self._felt
        self._felt = late
        for substep in range(substeps):
            ctrl[:] = last + (substep / substeps) * change
            self.batch.step()

    def snapshot(self, planned: Array) -> dict[str, Any]:
        """Return the first robot's row of a :class:`MotionLog`."""
        batch = self.batch
        pose = np.concatenate([self._place_now[0], self._quat[0]], axis=1)
        qpos = batch.bind("qpos")[0]
        dofs = [self.model.joint(name).dofadr[0] for name in ACTUATED]
        feet = [self.model.sensor(name).adr[0] for name in FSR]
        return {
            "targets": planned,
            "commands": self._setpoint[0].copy(),
            "angles": qpos[self._qpos].copy(),
            "velocities": batch.bind("qvel")[0][dofs].copy(),
            "torques": batch.bind("actuator_force")[0].copy(),
            "torso_pose": pose[self.torso],
            "body_pose": pose,
            "contacts": batch.bind("sensordata")[0][feet].copy(),
        }


def play_all(
    motion: Motion,
    trials: Trials,
    *,
    balance: bool = True,
    gains: Gains | None = None,
    threads: int = 0,
    progress: Callable[[int, int], None] | None = None,
    limits: str = "thesis",
) -> Outcome:
    """Play a motion in every trial.

    Args:
        motion: a trajectory, played as :func:`nao_sim.motion.perform.perform` does in the nominal trial, or a walk.
        trials: one robot each.
        balance, gains: of a trajectory's feedback.
        threads: of the batch; 0 for all cores. The outcome does not depend on it.
        progress: called with (periods done, periods in all).
        limits: the range set that the robots keep.
    """
    player = player_of(motion, len(trials), balance, gains)
    return _play(Crowd(trials, threads, limits), player, progress, None)


def replay(motion: Motion, trials: Trials, limits: str = "thesis") -> MotionLog:
    """Play the first trial alone and return its log."""
    rows: list[dict[str, Any]] = []
    outcome = _play(Crowd(trials, 1, limits), player_of(motion, 1), None, rows)
    times = np.asarray(CONTROL_PERIOD * np.arange(len(rows)), dtype=np.float64)
    columns: dict[str, Any] = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    fell_at = None if outcome.up[0] else float(outcome.fell_at[0])
    return MotionLog(time=times, **columns, fallen=fell_at is not None, fell_at=fell_at)


def _play(
    crowd: Crowd,
    player: Player,
    progress: Callable[[int, int], None] | None,
    rows: list[dict[str, Any]] | None,
) -> Outcome:
    count, steps = len(crowd.trials), len(player.planned) - 1
    fell_at, worst = np.full(count, np.nan), np.zeros(count)
    if rows is not None:
        rows.append(crowd.snapshot(player.planned[0]))
    for step in range(steps):
        commands = player.commands(step, crowd.lean(), crowd.rate())
        crowd.push(step / steps, steps * CONTROL_PERIOD)
        crowd.step(commands)
        newly = crowd.down() & np.isnan(fell_at)
        fell_at[newly] = (step + 1) * CONTROL_PERIOD
        # What was set back to its start no longer leans.
        lean = np.abs(crowd.lean() - player.leans[step + 1]).max(axis=1)
        worst = np.where(crowd.lost(), worst, np.maximum(worst, lean))
        if rows is not None:
            rows.append(crowd.snapshot(player.planned[step + 1]))
        if progress is not None:
            progress(step + 1, steps)
    return Outcome(fell_at, worst)


def _turn(about: Array) -> Rotation:
    """Return rotations about x and y for angles of shape (n, 2), rad."""
    return Rotation.from_rotvec(np.column_stack([about, np.zeros(len(about))]))


def _clamp_pairs(commands: Array) -> Array:
    """Return commands inside the anti-collision tables, shape (n, 25)."""
    safe = commands.copy()
    for table in pair_tables():
        given = safe[:, ACTUATED.index(table.given)]
        low, high = (np.interp(given, table.angles, edge) for edge in (table.least, table.greatest))
        column = ACTUATED.index(table.limits)
        safe[:, column] = np.clip(safe[:, column], low, high)
    return safe
