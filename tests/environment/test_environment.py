import dm_env
import numpy as np
import pytest
from absl.testing import absltest
from dm_env import test_utils

from nao_sim.environment import NaoPhysics, track
from nao_sim.gestures import GestureError, UnknownGesture, library
from nao_sim.motion import Trajectory, perform
from nao_sim.robot import ACTUATED, Nao, joint_table


class DmEnvContract(test_utils.EnvironmentTestMixin, absltest.TestCase):
    """dm_env's own contract tests."""

    def make_object_under_test(self) -> dm_env.Environment:
        return track("yes", seed=0, repetitions=1)

    def make_action_sequence(self):
        spec = self.make_action_spec()
        rng = np.random.default_rng(0)
        for _ in range(200):
            yield rng.uniform(spec.minimum, spec.maximum)

    def make_action_spec(self):
        return self.environment.action_spec()


@pytest.fixture(scope="module")
def environment():
    return track("yes", seed=3)


def play(environment, policy):
    step = environment.reset()
    steps = [step]
    while not step.last():
        step = environment.step(policy(step.observation))
        steps.append(step)
    return steps


def follow(observation):
    return observation["reference"]


def test_specs_say_what_comes(environment):
    action = environment.action_spec()
    low, high = joint_table().select(ACTUATED).range_rad().T
    assert action.shape == (25,)
    assert np.array_equal(action.minimum, low)
    assert np.array_equal(action.maximum, high)
    observed = environment.observation_spec()
    shapes = {name: spec.shape for name, spec in observed.items()}
    assert shapes == {
        "angles": (25,),
        "velocities": (25,),
        "reference": (25,),
        "lean": (2,),
        "planned_lean": (2,),
        "gyro": (3,),
        "feet": (8,),
        "left": (1,),
    }
    for step in play(environment, follow):
        for name, spec in observed.items():
            spec.validate(step.observation[name])
            assert np.isfinite(step.observation[name]).all()


def test_following_the_reference_is_rewarded_and_ends_with_the_gesture(environment):
    steps = play(environment, follow)
    assert len(steps) - 1 == round(library()["yes"].trajectory().duration / 0.02)
    rewards = [step.reward for step in steps[1:]]
    assert min(rewards) > 0.9
    assert steps[-1].discount == 1.0
    assert [float(step.observation["left"][0]) for step in (steps[0], steps[-1])] == [1.0, 0.0]


def test_standing_still_earns_less_and_falling_ends_it(environment):
    still = play(environment, lambda observation: environment.physics.standing[environment.physics.qpos_rows])
    assert np.mean([step.reward for step in still[1:]]) < np.mean(
        [step.reward for step in play(environment, follow)[1:]]
    )

    def topple(observation):
        action = observation["reference"].copy()
        action[[ACTUATED.index("LAnklePitch"), ACTUATED.index("RAnklePitch")]] = np.deg2rad(50)
        return action

    fallen = play(track("idle"), topple)
    assert fallen[-1].discount == 0.0
    assert fallen[-1].reward == 0.0


def test_observations_share_no_memory(environment):
    first = environment.reset().observation
    kept = {name: value.copy() for name, value in first.items()}
    for _ in range(10):
        environment.step(environment.action_spec().maximum)
    for name, value in first.items():
        assert np.array_equal(value, kept[name]), name


def test_same_seed_same_episodes_and_every_gesture_comes():
    names = ["yes", "no", "stop"]

    def lengths(seed):
        environment = track(names, seed=seed)
        return [len(play(environment, follow)) for _ in range(6)]

    one = lengths(5)
    assert one == lengths(5)
    assert len(set(one)) > 1


def test_it_is_the_robot_s_own_physics(environment):
    """Following the reference is what perform does without balance and without its lead."""
    trajectory = library()["yes"].trajectory()
    nao = Nao()
    early = Trajectory(trajectory.times + 0.02, trajectory.targets)
    log = perform(
        nao, Trajectory(np.r_[0.0, early.times], np.vstack([early.targets[:1], early.targets])), balance=False
    )
    steps = play(environment, follow)
    measured = np.array([step.observation["angles"] for step in steps])
    assert np.abs(measured - log.angles[: len(measured)]).max() < 1e-9


def test_unknown_and_walking_gestures_are_refused():
    with pytest.raises(UnknownGesture):
        track("yess")
    with pytest.raises(GestureError):
        track("walk_left_to_right")


def test_dm_control_and_mujoco_are_a_sound_pair(environment):
    assert isinstance(environment.physics, NaoPhysics)
    assert environment.physics.model.nu == 25


def test_gymnasium_s_checker_is_content():
    gymnasium = pytest.importorskip("gymnasium", reason="the extra 'gymnasium' is not installed")
    from gymnasium.utils.env_checker import check_env

    made = gymnasium.make("nao_sim.gym_environment:NaoTrackGesture-v0", gestures=["yes", "no"])
    check_env(made.unwrapped, skip_render_check=True)
    first, _ = made.reset(seed=4)
    second, _ = made.reset(seed=4)
    assert all(np.array_equal(first[name], second[name]) for name in first)
    made.close()
