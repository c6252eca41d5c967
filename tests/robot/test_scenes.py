"""The robot in other people's scenes: found wherever it is, standing on what is there, falling only when it falls."""

from __future__ import annotations

import doctest

import mujoco
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nao_sim.motion.measures import measure
from nao_sim.motion.perform import perform
from nao_sim.motion.trajectory import Trajectory
from nao_sim.motion.walking import walk
from nao_sim.resources import resource
from nao_sim.robot import ACTUATED, Nao, SceneError, find_robot, model_spec, nao, step_together
from nao_sim.robot.nao import substeps

BOX, SPHERE = mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_SPHERE
FLOOR = '<geom type="plane" size="3 3 .1"/>'
BALL = '<body name="ball" pos=".5 .1 .05"><freejoint/><geom type="sphere" size=".05" mass=".05"/></body>'
HINGE = '<body name="door" pos="1 1 1"><joint axis="0 0 1"/><geom type="box" size=".3 .02 .3" mass="1"/></body>'
SLIDER = '<body name="cart" pos="-1 1 .2"><joint type="slide" axis="1 0 0"/><geom type="sphere" size=".1"/></body>'


def _file_scene(before: str) -> mujoco.MjModel:
    robot = resource("models", "nao", "nao.xml")
    return mujoco.MjModel.from_xml_string(
        f'<mujoco><worldbody>{FLOOR}{before}</worldbody><include file="{robot}"/></mujoco>'
    )


def _box(spec: mujoco.MjSpec, name: str, pos: tuple[float, ...], size: tuple[float, ...], free: bool = False) -> None:
    body = spec.worldbody.add_body(name=name, pos=list(pos))
    body.add_geom(type=BOX, size=list(size), mass=5)
    if free:
        body.add_freejoint()


@pytest.mark.parametrize("before", ["", BALL, HINGE, SLIDER, BALL + HINGE + SLIDER])
def test_what_stands_before_it_moves_nothing_and_hides_nothing(before: str, standing: Nao) -> None:
    robot = Nao(model=_file_scene(before))
    standing.reset("StandInit")
    for one in (robot, standing):
        one.set_angles("HeadYaw", 0.5)
        one.step(50)
    assert not robot.fallen
    assert robot.angles == pytest.approx(standing.angles, abs=1e-3)
    assert robot.torso_pose == pytest.approx(standing.torso_pose, abs=1e-3)
    assert robot.fsr.sum() == pytest.approx(standing.fsr.sum(), rel=0.02)
    if BALL in before:
        assert robot.data.body("ball").xpos == pytest.approx([0.5, 0.1, 0.05], abs=0.01)


# MuJoCo tells of every option that the scene takes over from the robot.
@pytest.mark.filterwarnings("ignore:.*[Aa]ttach conflict")
@pytest.mark.parametrize(
    ("prefix", "suffix", "x", "y", "turn"),
    [("nao_", "", 0, 0, 0), ("a/", "", 1.5, -2, 3.1), ("n", "_x", -1, 0.3, -1.2), ("HeadYaw_", ".1", 0, 2, 0.7)],
)
def test_attached_anywhere_under_any_name(prefix: str, suffix: str, x: float, y: float, turn: float) -> None:
    scene = mujoco.MjSpec.from_string(
        f'<mujoco><compiler conflict="merge"/><worldbody>{FLOOR}{BALL.replace(".5 .1", "9 9")}</worldbody></mujoco>'
    )
    frame = scene.worldbody.add_frame(pos=[x, y, 0], quat=[np.cos(turn / 2), 0, 0, np.sin(turn / 2)])
    scene.attach(model_spec(scene=False), frame=frame, prefix=prefix, suffix=suffix)
    robot = Nao(model=scene.compile())
    assert robot.wiring.named("torso") == f"{prefix}torso{suffix}"
    robot.step(25)
    assert robot.torso_pose[:2] == pytest.approx([x, y], abs=0.01)
    heading = robot.data.xmat[robot.wiring.torso].reshape(3, 3)[:2, 0]
    assert np.arctan2(heading[1], heading[0]) == pytest.approx(turn, abs=0.02)
    assert not robot.fallen
    assert robot.sensors().fsr.sum() == pytest.approx(52, abs=4)


def test_a_scene_s_own_options_may_stay() -> None:
    """Attached without conflict="merge", the robot gets the scene's 2 ms and Euler; it stands all the same."""
    scene = mujoco.MjSpec.from_string(f"<mujoco><worldbody>{FLOOR}</worldbody></mujoco>")
    scene.attach(model_spec(scene=False), frame=scene.worldbody.add_frame(), prefix="nao_")
    with pytest.warns(UserWarning, match="conflict"):
        model = scene.compile()
    assert model.opt.timestep == 0.002
    robot = Nao(model=model)
    robot.step(100)
    assert not robot.fallen
    assert robot.time == pytest.approx(2.0)


@pytest.mark.parametrize("height", [0.02, 0.1, 0.25, 0.4])
@pytest.mark.parametrize("placed", [True, False])
def test_it_stands_on_a_stage(height: float, placed: bool) -> None:
    """Whether the scene has put the torso that much higher or left it where the robot's file has it."""
    spec = model_spec()
    _box(spec, "stage", (0, 0, height / 2), (0.5, 0.5, height / 2))
    if placed:
        spec.body("torso").pos[2] += height
    robot = Nao(model=spec.compile())
    robot.step(50)
    assert robot.torso_pose[2] == pytest.approx(height + 0.32, abs=0.005)
    assert not robot.fallen
    robot.reset("Sit")
    robot.step(100)
    assert robot.torso_pose[2] == pytest.approx(height + 0.1375, abs=0.01)
    assert not robot.fallen


def test_what_cannot_be_stood_on_is_said() -> None:
    spec = model_spec()
    _box(spec, "block", (0, 0, 1), (0.5, 0.5, 1))
    with pytest.raises(SceneError, match=r"begin \d+ mm inside 'block'; move that, or the body 'torso'"):
        Nao(model=spec.compile())


def _on_a_chair(free: bool) -> Nao:
    spec = model_spec()
    _box(spec, "seat", (-0.1, 0, 0.05), (0.12, 0.15, 0.05), free)
    spec.body("torso").pos[2] += 0.1
    return Nao(model=spec.compile(), posture="Sit")


@pytest.mark.parametrize("free", [True, False])
def test_sitting_on_a_chair_is_no_fall_and_falling_off_it_is(free: bool) -> None:
    robot = _on_a_chair(free)
    for _ in range(50):
        robot.step(2)
        assert not robot.fallen
    torso = robot.wiring.torso
    robot.data.xfrc_applied[torso, 1] = 40
    robot.step(25)
    robot.data.xfrc_applied[:] = 0
    robot.step(50)
    assert robot.torso_pose[2] < 0.2
    assert robot.fallen


@pytest.mark.parametrize(
    ("height", "back", "hip", "falls"),
    [(0.15, -0.13, -1.3, False), (0.15, -0.15, -1.1, False), (0.12, -0.13, -1.1, True)],
)
def test_who_sits_down_on_a_seat_sits_and_who_falls_over_it_falls(
    height: float, back: float, hip: float, falls: bool
) -> None:
    """A seat behind the thighs takes the weight while the feet stay on the floor; a low one is fallen over."""
    spec = model_spec()
    _box(spec, "seat", (back, 0, height / 2), (0.1, 0.15, height / 2))
    robot = Nao(model=spec.compile())
    goal = {"HipPitch": hip, "KneePitch": 1.8, "AnklePitch": -0.45}
    start = robot.setpoint
    fell = False
    for step in range(200):
        for name, angle in goal.items():
            before = start[ACTUATED.index(f"L{name}")]
            robot.set_angles([f"L{name}", f"R{name}"], before + min(1.0, step / 100) * (angle - before))
        robot.step()
        fell |= robot.fallen
    assert fell == falls
    lean = np.degrees(np.arccos(robot.data.xmat[robot.wiring.torso, 8]))
    assert (lean > 90) if falls else (lean < 15)
    assert robot.fsr.sum() < 45  # the seat bears


@pytest.mark.parametrize(("height", "pitch"), [(0.3, 0.5), (0.3, 0.8), (0.25, 1.0)])
def test_a_hand_on_a_table_is_no_fall(height: float, pitch: float) -> None:
    spec = model_spec()
    _box(spec, "table", (0.26, 0, height / 2), (0.12, 0.3, height / 2))
    robot = Nao(model=spec.compile())
    robot.set_angles(["RShoulderPitch", "RElbowRoll"], [pitch, 0.05])
    touched = False
    for _ in range(100):
        robot.step()
        assert not robot.fallen
        bodies = robot.model.geom_bodyid[robot.data.contact.geom]
        touched |= bool(np.isin(bodies, robot.model.body("table").id).any())
    assert touched
    assert robot.torso_pose[2] > 0.31


def test_a_ball_that_rolls_against_the_shins_is_no_fall() -> None:
    spec = model_spec()
    ball = spec.worldbody.add_body(name="ball", pos=[0.6, 0.05, 0.08])
    ball.add_freejoint()
    ball.add_geom(type=SPHERE, size=[0.08, 0, 0], mass=0.05)
    robot = Nao(model=spec.compile())
    robot.data.joint(robot.model.body("ball").jntadr[0]).qvel[:] = [-1.0, 0, 0, 0, -12.0, 0]
    reached = np.inf
    for _ in range(75):
        robot.step()
        reached = min(reached, robot.data.body("ball").xpos[0])
        assert not robot.fallen
    assert reached < 0.2


@pytest.mark.parametrize("push", [(25, 0), (-25, 0), (0, 25)])
def test_a_fall_from_a_stage_is_a_fall(push: tuple[int, int]) -> None:
    spec = model_spec()
    _box(spec, "stage", (0, 0, 0.1), (0.15, 0.15, 0.1))
    robot = Nao(model=spec.compile(), posture="StandZero")
    robot.step(10)
    robot.data.xfrc_applied[robot.wiring.torso, :2] = push
    robot.step(25)
    robot.data.xfrc_applied[:] = 0
    robot.step(75)
    assert robot.fallen


def test_a_motion_of_who_lies_is_logged_as_one_on_the_ground() -> None:
    robot = Nao(posture="LyingBack", fingers=False)
    assert not robot.fallen
    assert robot.lies
    log = perform(robot, Trajectory(np.zeros(1), robot.setpoint[None]), settle_s=0.1)
    assert (log.fallen, log.fell_at) == (True, 0.0)


@settings(max_examples=60, deadline=None)
@given(st.integers(1, 40))
def test_time_steps_that_divide_the_period_do(count: int) -> None:
    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    model.opt.timestep = 0.02 / count
    assert substeps(model) == count
    model.opt.timestep = float(f"{0.02 / count:.6g}")
    assert substeps(model) == count


@settings(max_examples=60, deadline=None)
@given(st.floats(2e-4, 0.5).filter(lambda step: abs(0.02 / step - round(0.02 / step)) > 0.01))
def test_other_time_steps_are_refused_in_one_line_with_one_that_does(step: float) -> None:
    model = mujoco.MjModel.from_xml_string("<mujoco/>")
    model.opt.timestep = step
    with pytest.raises(SceneError, match="does not divide the control period of 20 ms") as caught:
        substeps(model)
    assert "\n" not in str(caught.value)
    model.opt.timestep = float(str(caught.value).split('"')[1])
    assert substeps(model) >= 1


def _two(apart: float = 1.0) -> mujoco.MjModel:
    scene = model_spec()
    scene.attach(model_spec(scene=False), frame=scene.worldbody.add_frame(pos=[0, apart, 0]), prefix="b_")
    return scene.compile()


def test_several_robots_must_be_told_apart() -> None:
    model = _two()
    with pytest.raises(SceneError, match="has 2 NAOs; say which with prefix=: '', 'b_'"):
        Nao(model=model)
    with pytest.raises(SceneError, match="no NAO of the prefix 'c_' is in this scene; prefixes there: '', 'b_'"):
        Nao(model=model, prefix="c_")


def test_two_robots_in_one_state_do_what_each_is_told(standing: Nao) -> None:
    model = _two()
    state = mujoco.MjData(model)
    one, two = (Nao(model=model, data=state, prefix=prefix) for prefix in ("", "b_"))
    one.set_angles("HeadYaw", 0.5)
    two.set_angles("HeadYaw", -0.5)
    step_together((one, two), 60)
    assert state.time == pytest.approx(1.2)
    assert (one.angles[0], two.angles[0]) == pytest.approx((0.5, -0.5), abs=0.01)
    assert not one.fallen
    assert not two.fallen
    state.xfrc_applied[two.wiring.torso, 0] = 60
    step_together((one, two), 15)
    state.xfrc_applied[:] = 0
    step_together((one, two), 60)
    assert (one.fallen, two.fallen) == (False, True)
    kept = one.torso_pose
    two.reset("Stand")
    assert one.torso_pose == pytest.approx(kept)
    assert state.time > 2
    step_together((one, two), 25)
    assert not two.fallen
    with pytest.raises(SceneError, match="different states"):
        step_together((one, standing))


def test_a_motion_in_a_scene_is_measured_like_one_at_home(standing: Nao) -> None:
    model = _two(apart=2.0)
    robot = Nao(model=model, prefix="b_")
    standing.reset()
    times = np.array([0.0, 1.0])
    targets = np.repeat(standing.setpoint[None], 2, axis=0)
    targets[1, ACTUATED.index("RShoulderPitch")] = 0.3
    trajectory = Trajectory(times, targets)
    there = measure(model, trajectory, perform(robot, trajectory), prefix="b_")
    here = measure(standing.model, trajectory, perform(standing, trajectory))
    assert there.com_margin_mm.value == pytest.approx(here.com_margin_mm.value, abs=0.5)
    assert there.self_distance_mm.value == pytest.approx(here.self_distance_mm.value, abs=0.5)
    assert there.tracking_deg.value == pytest.approx(here.tracking_deg.value, abs=0.1)
    assert there.fell_at is None


def test_a_walk_in_a_scene_goes_where_it_is_sent() -> None:
    robot = Nao(model=_file_scene(BALL.replace(".5 .1", "2 2") + HINGE))
    log = walk(robot, 0.2)
    assert not log.fallen
    assert log.torso_pose[-1, 0] == pytest.approx(0.2, abs=0.05)


@pytest.mark.parametrize("group", range(6))
def test_sonar_hears_walls_of_any_group_and_not_the_robot(group: int) -> None:
    spec = model_spec()
    wall = spec.worldbody.add_body(name="wall", pos=[0.65, 0, 0.5])
    wall.add_geom(type=BOX, size=[0.02, 2, 0.5], group=group)
    robot = Nao(model=spec.compile())
    assert robot.sensors().sonar["Left"] == pytest.approx(0.58, abs=0.03)


@pytest.mark.parametrize(
    ("scene", "said"),
    [
        ("<mujoco/>", "no NAO in this scene"),
        (
            '<mujoco><worldbody><body><joint name="HeadYaw"/><geom size=".1"/></body></worldbody></mujoco>',
            "lacks joints",
        ),
    ],
)
def test_a_scene_without_the_robot_is_told_so(scene: str, said: str) -> None:
    with pytest.raises(SceneError, match=said):
        find_robot(mujoco.MjModel.from_xml_string(scene))


def test_a_robot_that_lost_its_motors_or_sensors_is_told_so() -> None:
    spec = model_spec()
    spec.delete(spec.actuator("LKneePitch"))
    for key in list(spec.keys):
        spec.delete(key)
    with pytest.raises(SceneError, match="no motors for LKneePitch"):
        Nao(model=spec.compile())
    spec = model_spec()
    spec.delete(spec.sensor("Gyrometer"))
    with pytest.raises(SceneError, match="no sensor 'Gyrometer'"):
        Nao(model=spec.compile())


@pytest.mark.filterwarnings("ignore:.*[Aa]ttach conflict")
def test_motors_are_found_where_others_take_several_inputs() -> None:
    """A motor with three inputs before the robot's moves the robot's own inputs in ctrl."""
    spec = mujoco.MjSpec.from_string(
        f"""<mujoco><compiler conflict="merge"/><worldbody>{FLOOR}<body pos="2 0 1"><joint name="crane" axis="0 1 0"/>
        <geom size=".1" mass="1"/></body></worldbody>
        <actuator><dcmotor joint="crane" nominal="24 2 5" input="pos vel ff"/></actuator></mujoco>"""
    )
    spec.attach(model_spec(scene=False), frame=spec.worldbody.add_frame(), prefix="n_")
    robot = Nao(model=spec.compile())
    assert robot.wiring.ctrl[0] == robot.wiring.motors[0] + 2
    robot.set_angles("HeadYaw", 0.4)
    robot.step(50)
    assert robot.angles[0] == pytest.approx(0.4, abs=0.01)
    assert not robot.fallen


def test_documented_examples_are_true() -> None:
    assert doctest.testmod(nao).failed == 0
