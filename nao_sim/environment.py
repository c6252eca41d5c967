"""For learners: the robot as a ``dm_env`` environment whose task is to perform a gesture without falling.

A step is one control period of 20 ms, as on the robot: the action is a set-point for each of the 25 motors, held inside
ranges and nominal speed by the same command layer that :class:`nao_sim.robot.Nao` has.

Action, shape (25,): targets in rad (hands: fraction open), columns as :data:`nao_sim.robot.ACTUATED`.

Observation, all float64:

================  =====  =====================================================================================
``angles``        (25,)  measured, rad
``velocities``    (25,)  measured, rad/s
``reference``     (25,)  where the gesture wants the joints at the end of the step to come, rad
``lean``          (2,)   roll and pitch of the torso, rad
``planned_lean``  (2,)   the same, as the gesture means it at the end of the step
``gyro``          (3,)   angular velocity in the torso's frame, rad/s
``feet``          (8,)   foot force sensors, N
``left``          (1,)   share of the gesture still to come, 1 … 0
================  =====  =====================================================================================

Reward, 0 … 1: ``exp(-e² / 2s²)`` with e the root mean square distance of the joints from the gesture and s = 0.1 rad;
0 once the robot is down. An episode ends with the gesture (discount 1) or with a fall (discount 0). An agent that
answers with ``reference`` plays the gesture without balance feedback.
"""

from __future__ import annotations

import math
from collections import OrderedDict
from collections.abc import Sequence
from typing import Any

import dm_env
import mujoco
import numpy as np
from dm_control import mujoco as dm_mujoco
from dm_control.mujoco import wrapper
from dm_control.rl import control
from dm_env import specs
from numpy.typing import NDArray

from nao_sim.gestures import find_gesture
from nao_sim.motion.balance import planned_lean
from nao_sim.motion.trajectory import CONTROL_PERIOD, Trajectory
from nao_sim.robot import ACTUATED, Nao, TargetError, find_robot, joint_table
from nao_sim.robot.command import CommandLayer
from nao_sim.robot.sensors import FSR

Array = NDArray[np.float64]

REWARD_WIDTH_RAD = 0.1
_NO_SENSORS = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
_DOWN_COS, _DOWN_HEIGHT_M = float(np.cos(np.deg2rad(85.0))), 0.17


class NaoPhysics(dm_mujoco.Physics):
    """The robot's model in dm_control; a step of the environment sends one set-point.

    Its state is that of the simulation, of the command layer on its way to the targets, and of the episode, so copies
    (``copy``, ``deepcopy``, ``pickle``) and what ``get_state`` returned go on exactly like the original.

    Attributes:
        command: the command layer.
        episode: number of control periods done, and of the gesture, shape (2,).
    """

    command: CommandLayer
    episode: Array
    _limits = "thesis"
    _standing: Array | None = None

    @classmethod
    def of_robot(cls, limits: str = "thesis") -> NaoPhysics:
        """Return the physics of a robot on its floor, with a limit set."""
        with Nao(limits=limits) as nao:
            physics = cls.from_model(wrapper.MjModel(nao.model))
            physics._limits, physics._standing = limits, nao.data.qpos.copy()
        physics.command = CommandLayer(limits, CONTROL_PERIOD)
        return physics

    def _reload_from_data(self, data: wrapper.MjData) -> None:
        super()._reload_from_data(data)
        model = self._raw_model = self.model.ptr
        raw = self.raw = self.data.ptr
        self.command = CommandLayer(self._limits, CONTROL_PERIOD)
        self.episode = np.zeros(2)
        robot = find_robot(model)
        self.qpos_rows, self.dof_rows, self._motors = robot.qpos, robot.dof, robot.ctrl
        self.fsr_rows = np.array([robot.sensor(name) for name in FSR])
        self.gyro_row = robot.sensor("Gyrometer")
        # Views into the simulation's own memory, kept because making them anew each step costs more than the rest.
        self.qpos, self.qvel, self.sensed, self.ctrl = raw.qpos, raw.qvel, raw.sensordata, raw.ctrl
        self.torso_up, self.torso_place = raw.xmat[robot.torso, 6:], raw.xpos[robot.torso]

    def copy(self, share_model: bool = False) -> NaoPhysics:
        """Return a copy that goes on like this one; see ``dm_control.mujoco.Physics.copy``."""
        return self._hand_on(super().copy(share_model))

    def __getstate__(self) -> dict[str, Any]:
        kept = {"limits": self._limits, "standing": self.standing, "command": self.command, "episode": self.episode}
        return kept | {"data": super().__getstate__()}

    def __setstate__(self, state: dict[str, Any]) -> None:
        super().__setstate__(state["data"])
        self._limits, self._standing = state["limits"], state["standing"]
        self.command, self.episode = state["command"], state["episode"]

    def _hand_on(self, other: NaoPhysics) -> NaoPhysics:
        other._limits, other._standing = self._limits, self._standing
        other.command, other.episode = CommandLayer(self._limits, CONTROL_PERIOD), self.episode.copy()
        other.command.restore(self.command.state())
        return other

    def get_state(self, sig: int | None = None) -> Array:
        """Return the whole state; with a signature, MuJoCo's own part of that kind (``mj_getState``)."""
        own = super().get_state(sig)
        return own if sig is not None else np.concatenate([own, self.command.state(), self.episode])

    def set_state(self, physics_state: Array, sig: int | None = None) -> None:
        """Go on from what :meth:`get_state` returned; raises ``ValueError`` for a state of another size."""
        if sig is not None:
            super().set_state(physics_state, sig)
            return
        expected = self.get_state().shape
        if physics_state.shape != expected:
            raise ValueError(f"a state of shape {physics_state.shape}; give what get_state() returned, {expected}")
        remembered = self.command.state().size
        own = physics_state.size - remembered - self.episode.size
        super().set_state(physics_state[:own])
        self.command.restore(physics_state[own : own + remembered])
        self.episode[:] = physics_state[own + remembered :]
        mujoco.mj_forward(self._raw_model, self.raw)

    @property
    def standing(self) -> Array:
        """Positions of the standing robot from which episodes start."""
        if self._standing is None:
            with Nao(limits=self._limits, model=self._raw_model) as nao:
                self._standing = nao.data.qpos.copy()
        return self._standing

    def stand(self) -> None:
        """Put the robot into StandInit, at rest."""
        self.qpos[:] = self.standing
        self.command.reset(self.standing[self.qpos_rows])
        self.ctrl[self._motors] = self.command.setpoint

    def step(self, nstep: int = 1) -> None:
        """Advance one control period: the set-point moves towards the targets, the motor boards interpolate.

        Args:
            nstep: physics steps in a control period.
        """
        raw, model, ctrl, motors = self.raw, self._raw_model, self.ctrl, self._motors
        start = self.command.setpoint
        change = (self.command.advance() - start) / nstep
        # Sensors are read once a period: the steps before the last skip them, which changes nothing else.
        model.opt.disableflags |= _NO_SENSORS
        for substep in range(nstep):
            if substep == nstep - 1:
                model.opt.disableflags &= ~_NO_SENSORS
            ctrl[motors] = start + substep * change
            mujoco.mj_step(model, raw)
        if raw.warning[mujoco.mjtWarning.mjWARN_BADQACC].number:
            raise control.PhysicsError("the simulation became unstable; look at what was commanded")

    def lean(self) -> Array:
        """Return roll and pitch of the torso, rad, shape (2,); one robot's :func:`nao_sim.motion.balance.lean_of`."""
        x, y, z = self.torso_up.tolist()
        return np.array([math.atan2(y, z), math.atan2(-x, math.hypot(y, z))])

    @property
    def down(self) -> bool:
        """Whether the torso lies or is about to."""
        return bool(self.torso_up[2] < _DOWN_COS or self.torso_place[2] < _DOWN_HEIGHT_M)


class TrackGesture(control.Task):
    """Follow a gesture.

    Args:
        trajectories: the gestures; each episode draws one.
        seed: of the draw.
        limits: the limit set that the actions are held in.
    """

    def __init__(self, trajectories: Sequence[Trajectory], seed: int | None = None, limits: str = "thesis") -> None:
        self._plans = []
        for trajectory in trajectories:
            steps = int(np.ceil(trajectory.duration / CONTROL_PERIOD - 1e-9))
            targets = trajectory.sample(np.asarray(np.arange(1, steps + 1) * CONTROL_PERIOD, dtype=np.float64))
            self._plans.append((targets, planned_lean(targets)))
        self._random = np.random.default_rng(seed)
        self._low, self._high = joint_table().select(ACTUATED).range_rad(limits).T

    def seed(self, seed: int) -> None:
        """Start the draw of gestures anew."""
        self._random = np.random.default_rng(seed)

    def initialize_episode(self, physics: NaoPhysics) -> None:
        """Stand, and draw the gesture of the episode."""
        physics.episode[:] = 0, self._random.integers(len(self._plans))
        physics.stand()

    def action_spec(self, physics: NaoPhysics) -> specs.BoundedArray:
        """Return the spec of the targets; the bounds are the joint ranges of the limit set."""
        return specs.BoundedArray((len(ACTUATED),), np.float64, self._low, self._high, name="targets")

    def before_step(self, action: Array, physics: NaoPhysics) -> None:
        """Send the targets; what is out of range is clipped.

        Raises:
            TargetError: not one finite number per motor.
        """
        asked = np.asarray(action, dtype=float)
        if asked.shape != self._low.shape or not np.isfinite(asked).all():
            raise TargetError(f"an action must be {self._low.size} finite numbers, one target in rad per motor")
        physics.command.set_all(np.minimum(np.maximum(asked, self._low), self._high))

    def after_step(self, physics: NaoPhysics) -> None:
        """Count the control periods."""
        physics.episode[0] += 1

    def _now(self, physics: NaoPhysics) -> tuple[int, Array, Array]:
        """Return the periods done, and targets and leans of the gesture."""
        tick, plan = int(physics.episode[0]), int(physics.episode[1])
        return (tick, *self._plans[plan])

    def get_observation(self, physics: NaoPhysics) -> OrderedDict[str, Array]:
        """Return the observation; see the module."""
        tick, targets, leans = self._now(physics)
        now = min(tick, len(targets) - 1)
        return OrderedDict(
            angles=physics.qpos[physics.qpos_rows],
            velocities=physics.qvel[physics.dof_rows],
            reference=targets[now].copy(),
            lean=physics.lean(),
            planned_lean=leans[now].copy(),
            gyro=physics.sensed[physics.gyro_row : physics.gyro_row + 3].copy(),
            feet=physics.sensed[physics.fsr_rows],
            left=np.array([1.0 - tick / len(targets)]),
        )

    def get_reward(self, physics: NaoPhysics) -> float:
        """Return how near the joints are to the gesture, 0 … 1."""
        if physics.down:
            return 0.0
        tick, targets, _ = self._now(physics)
        error = physics.qpos[physics.qpos_rows] - targets[min(tick, len(targets)) - 1]
        return math.exp(-float(error @ error) / len(error) / (2 * REWARD_WIDTH_RAD**2))

    def get_termination(self, physics: NaoPhysics) -> float | None:
        """Return the discount of the last step, or None while the episode goes on."""
        if physics.down:
            return 0.0
        tick, targets, _ = self._now(physics)
        return 1.0 if tick >= len(targets) else None


def track(
    gestures: str | Sequence[str] = "bye_right", seed: int | None = None, limits: str = "thesis", **options: Any
) -> dm_env.Environment:
    """Return an environment whose task is to perform gestures.

    Args:
        gestures: a library name or a gesture file, or several; each episode draws one.
        seed: of the draw; the same seed and actions give the same observations.
        limits: the robot's limit set, ``"thesis"``, ``"v5"`` or ``"envelope"``.
        **options: how to prepare the gestures, as for :meth:`nao_sim.gestures.Gesture.trajectory`.

    Raises:
        GestureError: an unknown gesture, or one that has no fixed trajectory.

    Example:
        >>> environment = track("yes", seed=1)
        >>> step = environment.reset()
        >>> while not step.last():
        ...     step = environment.step(step.observation["reference"])
        >>> bool(step.reward > 0.9)
        True
    """
    names = [gestures] if isinstance(gestures, str) else list(gestures)
    trajectories = [find_gesture(name, limits=limits).trajectory(limits=limits, **options) for name in names]
    task = TrackGesture(trajectories, seed, limits)
    return control.Environment(NaoPhysics.of_robot(limits), task, control_timestep=CONTROL_PERIOD, legacy_step=False)
