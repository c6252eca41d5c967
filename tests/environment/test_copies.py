"""Environments that are copied, pickled, restored or sent to another process go on like the original."""

from __future__ import annotations

import copy
import multiprocessing
import pickle
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from nao_sim.environment import track
from nao_sim.errors import NaoSimError
from nao_sim.robot import ACTUATED, Nao, TargetError

WAYS: dict[str, Callable[[Any], Any]] = {
    "copy": copy.deepcopy,
    "pickle": lambda value: pickle.loads(pickle.dumps(value)),
    "pickle of a copy": lambda value: pickle.loads(pickle.dumps(copy.deepcopy(value))),
}
RNG = np.random.default_rng(3)


def _actions(environment: Any, count: int) -> list[np.ndarray]:
    spec = environment.action_spec()
    return [RNG.uniform(spec.minimum, spec.maximum) for _ in range(count)]


def _same(one: Any, two: Any) -> bool:
    return all(np.array_equal(one.observation[key], two.observation[key]) for key in one.observation) and (
        (one.reward, one.discount, one.step_type) == (two.reward, two.discount, two.step_type)
    )


@pytest.mark.parametrize("way", WAYS)
@pytest.mark.parametrize(("done", "limits"), [(0, "thesis"), (7, "v5")])
def test_a_clone_goes_on_bit_for_bit(way: str, done: int, limits: str) -> None:
    environment = track(["yes", "no"], seed=2, limits=limits)
    environment.reset()
    for action in _actions(environment, done):
        environment.step(action)
    other = WAYS[way](environment)
    following = _actions(environment, 12)
    seen = [environment.step(action) for action in following]
    # Afterwards, so that a clone that shares anything with its original would show.
    assert all(_same(one, other.step(action)) for one, action in zip(seen, following, strict=True))
    # The draw of the episodes to come is theirs, too.
    for _ in range(3):
        assert _same(environment.reset(), other.reset())


@pytest.mark.parametrize("way", WAYS)
def test_a_clone_of_a_fresh_environment_begins_like_it(way: str) -> None:
    environment = track(["yes", "no"], seed=2)
    other = WAYS[way](environment)
    action = np.zeros(25)
    assert _same(environment.step(action), other.step(action))
    assert _same(environment.step(action), other.step(action))


@pytest.mark.parametrize("share", [True, False])
def test_a_copy_of_the_physics_plans_ahead_without_a_trace(share: bool) -> None:
    environment = track("yes", seed=0)
    environment.reset()
    actions = _actions(environment, 10)
    for action in actions[:5]:
        environment.step(action)
    planned = environment.physics.copy(share_model=share)
    kept = environment.physics.get_state()
    for action in actions[5:]:
        environment.task.before_step(action, planned)
        planned.step(4)
        environment.task.after_step(planned)
    assert np.array_equal(environment.physics.get_state(), kept)
    for action in actions[5:]:
        environment.step(action)
    assert np.array_equal(environment.physics.get_state(), planned.get_state())


def test_a_state_put_back_leads_to_the_same_again() -> None:
    environment = track(["yes", "no"], seed=0)
    environment.reset()
    actions = _actions(environment, 20)
    for action in actions[:8]:
        environment.step(action)
    kept = environment.physics.get_state()
    first = [environment.step(action) for action in actions[8:]]
    environment.physics.set_state(kept)
    assert all(_same(one, environment.step(action)) for one, action in zip(first, actions[8:], strict=True))
    # As dm_control's own environments are restored.
    with environment.physics.reset_context():
        environment.physics.set_state(kept)
    assert all(_same(one, environment.step(action)) for one, action in zip(first, actions[8:], strict=True))
    with pytest.raises(ValueError, match="give what get_state"):
        environment.physics.set_state(kept[:-1])


def _steps_elsewhere(environment: Any, actions: list[np.ndarray]) -> list[np.ndarray]:
    return [environment.step(action).observation["angles"] for action in actions]


def _gym_steps_elsewhere(environment: Any, actions: list[np.ndarray]) -> list[np.ndarray]:
    return [environment.step(action)[0]["angles"] for action in actions]


def test_another_process_goes_on_like_this_one() -> None:
    gymnasium = pytest.importorskip("gymnasium", reason="the extra 'gymnasium' is not installed")
    environment = track("yes", seed=0)
    environment.reset()
    made = gymnasium.make("nao_sim.gym_environment:NaoTrackGesture-v0", gestures="yes")
    made.reset(seed=0)
    actions = _actions(environment, 4)
    scaled = [RNG.uniform(-1, 1, 25).astype(np.float32) for _ in range(4)]
    with multiprocessing.get_context("spawn").Pool(1) as pool:
        there = pool.apply(_steps_elsewhere, (environment, actions))
        gym_there = pool.apply(_gym_steps_elsewhere, (made, scaled))
    assert np.array_equal(there, _steps_elsewhere(environment, actions))
    assert np.array_equal(gym_there, _gym_steps_elsewhere(made, scaled))


@pytest.mark.parametrize("way", WAYS)
def test_a_gymnasium_environment_goes_on_too(way: str) -> None:
    gymnasium = pytest.importorskip("gymnasium", reason="the extra 'gymnasium' is not installed")
    made = gymnasium.make("nao_sim.gym_environment:NaoTrackGesture-v0", gestures=["yes", "no"], limits="v5")
    made.reset(seed=1)
    for _ in range(5):
        made.step(made.action_space.sample())
    other = WAYS[way](made)
    action = RNG.uniform(-1, 1, 25).astype(np.float32)
    for _ in range(5):
        one, two = made.step(action), other.step(action)
        assert all(np.array_equal(one[0][key], two[0][key]) for key in one[0])
        assert one[1:4] == two[1:4]
    assert np.array_equal(made.reset()[0]["reference"], other.reset()[0]["reference"])


def test_a_gymnasium_step_outside_an_episode_is_said() -> None:
    gymnasium = pytest.importorskip("gymnasium", reason="the extra 'gymnasium' is not installed")
    from nao_sim.gym_environment import NaoTrackGesture, NoEpisodeError

    environment = NaoTrackGesture("yes")
    action = np.zeros(25, np.float32)
    with pytest.raises(NoEpisodeError, match=r"the episode has not begun; call reset\(\)"):
        environment.step(action)
    with pytest.raises(gymnasium.error.ResetNeeded):
        environment.step(action)
    environment.reset(seed=0)
    over = False
    while not over:
        *_, fell, ended, _ = environment.step(action)
        over = fell or ended
    with pytest.raises(NoEpisodeError, match="is over"):
        environment.step(action)
    environment.reset()
    environment.step(action)
    with pytest.raises(NaoSimError, match="no render mode 'human'"):
        NaoTrackGesture("yes", render_mode="human")


@pytest.mark.parametrize(
    "bad", [np.full(25, np.nan), np.full(25, np.inf), np.zeros(24), np.zeros((1, 25)), np.zeros(1), 0.0]
)
def test_what_is_no_action_is_refused_and_moves_nothing(bad: np.ndarray) -> None:
    pytest.importorskip("gymnasium", reason="the extra 'gymnasium' is not installed")
    from nao_sim.gym_environment import NaoTrackGesture

    environment = track("yes")
    environment.reset()
    before = environment.physics.get_state()
    with pytest.raises(TargetError):
        environment.step(bad)
    assert np.array_equal(environment.physics.get_state(), before)
    other = NaoTrackGesture("yes")
    other.reset()
    with pytest.raises(TargetError, match="25 finite numbers"):
        other.step(bad)


def test_an_environment_of_a_limit_set_keeps_it() -> None:
    environment = track("yes", limits="v5")
    spec = environment.action_spec()
    row = ACTUATED.index("RShoulderRoll")
    assert spec.maximum[row] == pytest.approx(np.deg2rad(18))
    environment.reset()
    action = environment.reset().observation["angles"].clip(spec.minimum, spec.maximum)
    action[row] = 0.3
    for _ in range(25):
        step = environment.step(action)
    assert step.observation["angles"][row] == pytest.approx(0.3, abs=0.02)


@pytest.mark.parametrize("way", WAYS)
def test_a_robot_can_be_cloned_as_well(way: str) -> None:
    nao = Nao()
    nao.set_angles("LArm", [0.2, 0.4, -1.0, -0.8, 0.1, 0.5])
    nao.step(7)
    other = WAYS[way](nao)
    nao.step(20)
    other.step(20)
    assert np.array_equal(nao.data.qpos, other.data.qpos)
    other.step(5)
    assert nao.time != other.time
    assert np.array_equal(nao.setpoint, other.targets) or nao.time < other.time
