"""The robot: load, reset to a posture, set targets, step, read sensors and cameras."""

from __future__ import annotations

from collections.abc import Sequence

import mujoco
import numpy as np
from numpy.typing import ArrayLike

from nao_sim.robot.camera import HEIGHT_PX, RATE_HZ, WIDTH_PX, Cameras
from nao_sim.robot.command import CommandLayer
from nao_sim.robot.errors import SceneError, TargetError, UnstableError
from nao_sim.robot.falling import FallDetector
from nao_sim.robot.joints import ACTUATED, BODY, resolve
from nao_sim.robot.model import model_spec
from nao_sim.robot.placement import place
from nao_sim.robot.postures import posture as posture_named
from nao_sim.robot.sensors import SensorReader, SensorReadings, consecutive
from nao_sim.robot.video import Video
from nao_sim.robot.wiring import find_robot

CONTROL_PERIOD_S = 0.02
"""NAOqi's cycle: a set-point for every motor each 20 ms (thesis app. 1)."""

_STEP_ROUNDING = 1e-4
"""Share of the control period by which a time step printed with a few digits may miss it."""

_NO_SENSORS = int(mujoco.mjtDisableBit.mjDSBL_SENSOR)
_BAD_STATE = slice(int(mujoco.mjtWarning.mjWARN_BADQPOS), int(mujoco.mjtWarning.mjWARN_BADQACC) + 1)


class Nao:
    """A NAO in MuJoCo, commanded like the real one.

    Args:
        limits: ``"thesis"`` (table A1-1), ``"v5"`` (H25 V5.0) or ``"envelope"`` (what both allow).
        mass: ``"documented"`` (5.305 kg) or ``"thesis"`` (4.3 kg).
        base: ``"free"``, or ``"fixed"`` with the torso hung up.
        fingers: False keeps fingertips and thumbs rigid.
        shells: False leaves out the shells that only pictures need; the robot moves the same, a tenth faster.
        posture: the posture to start in.
        model: a compiled scene of one's own that contains the robot (see :func:`nao_sim.robot.model_spec`), wherever
            in it; the other arguments but ``limits`` and ``posture`` are then its own affair.
        prefix: which robot, where the scene has several: what stands before its names.
        data: a state of that scene to share with other robots (see :func:`nao_sim.robot.step_together`); a reset then
            moves this robot only.

    Attributes:
        model, data: MuJoCo's, to look at; command through the methods.
        wiring: where this robot is in them.

    Raises:
        UnknownNameError: no such limit set, posture …
        SceneError: the scene has no robot, or several; its time step does not divide the control period; the robot
            would begin inside something.

    Example:
        >>> nao = Nao()
        >>> nao.set_angles("HeadYaw", 0.5)
        >>> nao.step(50)
        >>> bool(abs(nao.angles[0] - 0.5) < 0.01)
        True
    """

    def __init__(
        self,
        limits: str = "thesis",
        mass: str = "documented",
        base: str = "free",
        fingers: bool = True,
        posture: str = "StandInit",
        model: mujoco.MjModel | None = None,
        shells: bool = True,
        prefix: str | None = None,
        data: mujoco.MjData | None = None,
    ) -> None:
        if model is None:
            model = model_spec(limits, mass, base, fingers, shells=shells).compile()
        self.model = model
        self.data = mujoco.MjData(self.model) if data is None else data
        self.limits = limits
        self.wiring = find_robot(model, prefix)
        self._alone = data is not None
        self._command = CommandLayer(limits, CONTROL_PERIOD_S)
        steps = substeps(model)
        # The motor boards interpolate between two set-points; each step gets the value at its beginning, so that the
        # result hardly depends on the time step.
        self._ramp = np.arange(steps)[:, np.newaxis] / steps
        self._qpos, self._dof = self.wiring.qpos, self.wiring.dof
        self._motors = consecutive(self.wiring.motors.tolist())
        self._ctrl = consecutive(self.wiring.ctrl.tolist())
        self._torso = self.wiring.torso
        self._sensors = SensorReader(self.wiring)
        self._falls = FallDetector(self.wiring)
        self._cameras = Cameras(self.wiring)
        self._resets = 0
        self.reset(posture)

    @property
    def control_period(self) -> float:
        """Seconds between set-points."""
        return CONTROL_PERIOD_S

    @property
    def time(self) -> float:
        """Simulated seconds since the reset."""
        return float(self.data.time)

    def reset(self, posture: str = "StandInit") -> None:
        """Put the robot into an official posture, at rest, targets included, on what is under it in the scene.

        Raises:
            UnknownNameError: no such posture; the message names the nearest.
            SceneError: the robot would begin inside something.
        """
        wanted = posture_named(posture)
        ground = place(self.model, self.data, wanted, self.limits, self.wiring, self._alone)
        angles = wanted.clamped(self.limits)
        self._command.reset(angles[[BODY.index(name) for name in ACTUATED]])
        self.data.ctrl[self._ctrl] = self._command.setpoint
        self._falls.reset(wanted, ground)
        self._resets += 1
        mujoco.mj_forward(self.model, self.data)

    def set_angles(self, names: str | Sequence[str], angles_rad: ArrayLike, speed: float = 1.0) -> None:
        """Ask joints to go to angles, as fast as their motors' nominal speed allows, or a share of it.

        Args:
            names: a joint, a chain (``Head``, ``LArm``, ``RArm``, ``LLeg``, ``RLeg``, ``Arms``, ``Legs``, ``Body``,
                ``JointActuators``), or a list of them.
            angles_rad: one number for all, or one per joint; hands take 0 (closed) to 1 (open).
            speed: share of the nominal speed, above 0 and at most 1; NAOqi's ``fractionMaxSpeed``.

        Raises:
            UnknownNameError: no such joint; the message names the nearest.
            AngleRangeError: an angle beyond its range; the message has joint, value and both bounds.
            TargetError: not finite, or not one number per joint.
        """
        self._command.set(names, angles_rad, speed)

    def get_angles(self, names: str | Sequence[str] = "Body") -> np.ndarray:
        """Return ``(n,)`` measured angles of joints or chains, rad (hands: open fraction), in NAOqi's order.

        Args:
            names: as for :meth:`set_angles`; ``"Body"`` is all 26, both HipYawPitch joints among them.

        Raises:
            UnknownNameError: no such joint; the message names the nearest.
        """
        addresses = [self.model.jnt_qposadr[self.wiring.joint(name)] for name in resolve(names)]
        return self.data.qpos[addresses]

    def interpolate(self, names: str | Sequence[str], angles_rad: ArrayLike, seconds: float) -> None:
        """Bring joints to angles in a time, evenly, and come back when it is over; NAOqi's ``angleInterpolation``.

        Args:
            names, angles_rad: as for :meth:`set_angles`.
            seconds: how long it shall take; the motors' nominal speed may need longer.

        Raises:
            UnknownNameError, AngleRangeError, TargetError: as :meth:`set_angles`; nothing has moved then.
            UnstableError: as :meth:`step`.
        """
        if not 0 < seconds < np.inf:
            raise TargetError(f"a motion of {seconds} s; give seconds above 0")
        start = self.targets
        self.set_angles(names, angles_rad)
        goal = self.targets
        periods = max(1, round(seconds / CONTROL_PERIOD_S))
        for period in range(1, periods + 1):
            self.set_targets(start + (goal - start) * period / periods)
            self.step()

    def set_targets(self, targets: np.ndarray) -> None:
        """Set all ``(25,)`` targets in ``ACTUATED`` order; the fast form of :meth:`set_angles`, same checks."""
        self._command.set_all(targets)

    @property
    def targets(self) -> np.ndarray:
        """``(25,)`` where the joints are asked to go, rad (hands: open fraction), inside ranges and tables."""
        return self._command.targets.copy()

    @property
    def setpoint(self) -> np.ndarray:
        """``(25,)`` what the motors are told now, on its rate-limited way to the targets."""
        return self._command.setpoint.copy()

    @property
    def angles(self) -> np.ndarray:
        """``(25,)`` measured joint angles, rad (hands: open fraction)."""
        return self.data.qpos.take(self._qpos)

    @property
    def velocities(self) -> np.ndarray:
        """``(25,)`` measured joint velocities, rad/s."""
        return self.data.qvel.take(self._dof)

    @property
    def torques(self) -> np.ndarray:
        """``(25,)`` motor torques at the joints, Nm."""
        return self.data.actuator_force[self._motors].copy()

    @property
    def torso_pose(self) -> np.ndarray:
        """``(7,)`` position in m and orientation (w, x, y, z) of the torso in the world."""
        return np.concatenate([self.data.xpos[self._torso], self.data.xquat[self._torso]])

    @property
    def fsr(self) -> np.ndarray:
        """``(8,)`` foot forces in N, left foot first: front left, front right, rear left, rear right."""
        return self._sensors.fsr(self.data)

    @property
    def fallen(self) -> bool:
        """Whether the robot is down and not by design: it lies, or bears on the ground with more than its feet.

        To touch something, or to sit on a seat, is no fall; see :mod:`nao_sim.robot.falling`.
        """
        return self._falls.fallen(self.data)

    @property
    def lies(self) -> bool:
        """Whether the robot lies, be it by design (``LyingBack``) or not."""
        return self._falls.lies(self.data)

    @property
    def gyro(self) -> np.ndarray:
        """``(3,)`` angular velocity in the torso's frame, rad/s."""
        return self._sensors.gyro(self.data)

    def step(self, n: int = 1) -> None:
        """Advance ``n`` control periods of 20 ms.

        Raises:
            UnstableError: the state is no longer finite; reset, and look at what was commanded.
        """
        step_together((self,), n)

    def _ramp_of_period(self) -> np.ndarray:
        """Move the set-point one period on; return what the motors get at each step on the way, ``(steps, 25)``."""
        start = self._command.setpoint
        return start + self._ramp * (self._command.advance() - start)

    def sensors(self) -> SensorReadings:
        """Return the inertial unit, foot forces, bumpers, touch sensors and sonars now."""
        return self._sensors.read(self.data)

    def camera(
        self,
        name: str | mujoco.MjvCamera = "CameraTop",
        width: int = WIDTH_PX,
        height: int = HEIGHT_PX,
        fine: bool = False,
    ) -> np.ndarray:
        """Return what a camera sees at this moment, ``(height, width, 3)`` uint8 RGB.

        :meth:`video` gives pictures at the camera's documented rate instead.

        Args:
            name: ``"CameraTop"``, ``"CameraBottom"``, ``"outside"``, a camera of the scene, or a free camera.
            width, height: pixels.
            fine: with shadows, the scene's own sky and smoothed edges, at several times the cost.

        Raises:
            UnknownNameError: no such camera.
            RenderError: this machine cannot render; the message says what to install.
        """
        return self._cameras.render(self.data, name, width, height, fine)

    def video(
        self,
        name: str | mujoco.MjvCamera = "CameraTop",
        width: int = WIDTH_PX,
        height: int = HEIGHT_PX,
        rate_hz: float = RATE_HZ,
        fine: bool = False,
    ) -> Video:
        """Return a camera that has a new picture every 1/30 s of simulated time, as documented.

        Step the robot as you like and call the video's ``read`` after each step: it returns the new picture, or None
        where none has fallen due.

        Args:
            name, width, height, fine: as for :meth:`camera`.
            rate_hz: images per second, at most the documented 30.

        Raises:
            RobotError: an impossible rate.
            UnknownNameError: no such camera.
        """
        if isinstance(name, str):
            self._cameras.known(name)
        return Video(lambda: (self._resets, self.time), lambda: self.camera(name, width, height, fine), rate_hz)

    def close(self) -> None:
        """Free the renderers, if any picture was taken."""
        self._cameras.close()

    def __enter__(self) -> Nao:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


def substeps(model: mujoco.MjModel) -> int:
    """Return how many time steps of a model make a control period.

    Raises:
        SceneError: no whole number does.
    """
    ratio = CONTROL_PERIOD_S / model.opt.timestep
    steps = round(ratio)
    if steps < 1 or abs(ratio - steps) > _STEP_ROUNDING * steps:
        fitting = CONTROL_PERIOD_S / int(np.ceil(ratio))
        raise SceneError(
            f"the scene's time step of {1e3 * model.opt.timestep:g} ms does not divide the control period of 20 ms; "
            f'set <option timestep="{fitting:.6g}"/>, or 0.005 as in the robot\'s own file'
        )
    return steps


def step_together(robots: Sequence[Nao], n: int = 1) -> None:
    """Advance robots that share one scene and state ``n`` control periods of 20 ms.

    Args:
        robots: made with the same ``model`` and ``data``.
        n: how many periods.

    Raises:
        SceneError: they are not in one scene.
        UnstableError: the state is no longer finite; reset, and look at what was commanded.

    Example:
        >>> import mujoco
        >>> from nao_sim.robot import model_spec
        >>> scene = model_spec()
        >>> place = scene.worldbody.add_frame(pos=[0, 1, 0])
        >>> _ = scene.attach(model_spec(scene=False), frame=place, prefix="second_")
        >>> model = scene.compile()
        >>> state = mujoco.MjData(model)
        >>> pair = [Nao(model=model, data=state, prefix=prefix) for prefix in ("", "second_")]
        >>> step_together(pair, 50)
        >>> [robot.fallen for robot in pair]
        [False, False]
    """
    model, data = robots[0].model, robots[0].data
    if any(robot.data is not data for robot in robots):
        raise SceneError("these robots are in different states; make them with the same model= and data=")
    option, ctrl, bad = model.opt, data.ctrl, data.warning.number[_BAD_STATE]
    for _ in range(n):
        ramps = [(robot._ctrl, robot._ramp_of_period()) for robot in robots]
        last = len(ramps[0][1]) - 1
        # Sensors are read once a period: the steps before the last skip them, which changes nothing else.
        option.disableflags |= _NO_SENSORS
        for step in range(last + 1):
            if step == last:
                option.disableflags &= ~_NO_SENSORS
            for motors, ramp in ramps:
                ctrl[motors] = ramp[step]
            mujoco.mj_step(model, data)
        if any(bad.tolist()):
            raise UnstableError(f"the simulation became unstable at {data.time:.3f} s; reset and check the targets")
