import numpy as np
import pytest

from nao_sim.gestures import library
from nao_sim.motion import Trajectory, perform
from nao_sim.motion.crowd import Crowd, play_all, replay
from nao_sim.motion.measures import Criteria, measure
from nao_sim.motion.stress import describe_trial, replay_trial, stress
from nao_sim.motion.trials import FACTORS, draw_trials
from nao_sim.robot import ACTUATED, AngleRangeError, Nao, model_spec, posture

HOME = np.array([posture("StandInit")[name] for name in ACTUATED])


@pytest.fixture(scope="module")
def nao():
    return Nao(fingers=False)


@pytest.fixture(scope="module")
def yes():
    return library()["yes"].trajectory()


@pytest.fixture(scope="module")
def log(nao, yes):
    nao.reset()
    return perform(nao, yes)


def test_the_log_has_a_row_every_control_period(log, nao, yes):
    assert np.allclose(np.diff(log.time), nao.control_period)
    assert log.time[-1] == pytest.approx(yes.duration + 0.5)
    rows = len(log.time)
    shapes = {
        "targets": (rows, 25),
        "commands": (rows, 25),
        "angles": (rows, 25),
        "velocities": (rows, 25),
        "torques": (rows, 25),
        "torso_pose": (rows, 7),
        "body_pose": (rows, nao.model.nbody, 7),
        "contacts": (rows, 8),
    }
    assert {name: getattr(log, name).shape for name in shapes} == shapes


def test_rows_do_not_share_the_simulation_s_memory(log):
    assert np.ptp(log.angles[:, ACTUATED.index("HeadPitch")]) > 0.3
    assert np.ptp(log.body_pose[:, :, :3]) > 0


def test_the_feet_carry_the_weight(log):
    weight = log.contacts[-20:].sum(axis=1).mean()
    assert weight == pytest.approx(5.305 * 9.81, rel=0.05)


def test_the_same_motion_twice_is_the_same(nao, yes, log):
    nao.reset()
    again = perform(nao, yes)
    assert np.array_equal(again.angles, log.angles)


def test_progress_is_told(nao):
    nao.reset()
    told = []
    perform(nao, Trajectory(np.zeros(1), HOME[None]), progress=lambda done, total: told.append((done, total)))
    assert told[-1] == (25, 25)


def test_a_motion_out_of_range_is_refused(nao):
    nao.reset()
    targets = HOME.copy()
    targets[ACTUATED.index("HeadYaw")] = 3.0
    with pytest.raises(AngleRangeError, match="HeadYaw"):
        perform(nao, Trajectory(np.array([0.0, 1.0]), np.stack([HOME, targets])), balance=False)


def test_a_fall_is_told_with_its_time(nao):
    nao.reset()
    targets = HOME.copy()
    for name in ("LAnklePitch", "RAnklePitch"):
        targets[ACTUATED.index(name)] = np.deg2rad(45)
    log = perform(nao, Trajectory(np.array([0.0, 0.5, 3.0]), np.stack([HOME, targets, targets])), balance=False)
    assert log.fallen
    assert 0.3 < log.fell_at < 3.0
    measures = measure(nao.model, Trajectory(np.array([0.0, 1.0]), np.stack([HOME, HOME])), log)
    assert not measures.ends_standing
    assert any(fault.startswith("fell at") for fault in Criteria().faults(measures))


def test_a_push_of_0_3_ns_is_survived_in_every_direction(yes):
    pushed = draw_trials(0, range(16), Nao(fingers=False).model.nbody, {})
    angles = np.linspace(0, 2 * np.pi, 8, endpoint=False)
    # Eight pushes of the size that must be survived, and eight so hard that they are surely felt.
    pushed.push_ns[:] = np.outer(np.repeat([0.3, 3.0], 8), [1, 1]) * np.tile([np.cos(angles), np.sin(angles)], 2).T
    outcome = play_all(yes, pushed, threads=1)
    assert outcome.up[:8].all()
    assert outcome.worst_lean[8:].min() > np.deg2rad(2)


def test_the_nominal_trial_is_perform_bit_for_bit(nao, yes, log):
    alone = replay(yes, draw_trials(0, [0], nao.model.nbody, {}))
    for name in ("commands", "angles", "torques", "torso_pose", "contacts"):
        assert np.array_equal(getattr(alone, name), getattr(log, name)), name


def test_trials_depend_on_seed_and_number_only():
    few, many = draw_trials(7, [2], 30), draw_trials(7, range(4), 30)
    for name in vars(few):
        assert np.array_equal(getattr(few, name)[0], getattr(many, name)[2]), name
    assert not np.array_equal(draw_trials(8, [2], 30).mass, few.mass)


def test_trials_stay_in_their_spread():
    drawn = draw_trials(0, range(200), 30)
    assert 0.9 <= drawn.mass.min() < 0.92
    assert 1.08 < drawn.mass.max() <= 1.1
    assert 0.4 <= drawn.friction.min() < drawn.friction.max() <= 1.0
    assert 0.85 <= drawn.strength.min() < drawn.strength.max() <= 1.15
    assert np.allclose(np.linalg.norm(drawn.push_ns, axis=1), 0.3)
    assert np.allclose(np.rad2deg(np.linalg.norm(drawn.tilt_rad, axis=1)), 2.0)
    assert set(drawn.delay) == {0, 1}


@pytest.mark.parametrize("factor", FACTORS)
def test_a_factor_alone_leaves_the_others_nominal(factor):
    nominal, one = draw_trials(0, [0], 30, {}), draw_trials(0, [0], 30, {factor: 2.0})
    differ = [name for name in vars(one) if not np.array_equal(getattr(one, name), getattr(nominal, name))]
    assert [name.split("_")[0] for name in differ] == [factor]


def test_stress_counts_names_and_replays_a_fall(yes):
    # Trials too hard on purpose, so that there are falls to count.
    report = stress(yes, 12, 5, sweep=False, threads=1, sizes=dict.fromkeys(FACTORS, 8.0))
    assert 0 < len(report.fell) <= 12
    assert report.upright_share == pytest.approx(1 - len(report.fell) / 12)
    again = replay_trial(yes, 5, report.fell[0], dict.fromkeys(FACTORS, 8.0))
    assert again.fell_at == pytest.approx(report.fell_at_s[0])
    assert set(describe_trial(5, 0)) >= {"friction", "push_ns", "delay_periods"}


def test_the_result_does_not_depend_on_threads(yes):
    trials = draw_trials(1, range(3), Nao(fingers=False).model.nbody)
    one, two = play_all(yes, trials, threads=1), play_all(yes, trials, threads=2)
    assert np.array_equal(one.worst_lean, two.worst_lean)


def test_a_trial_whose_simulation_is_lost_did_not_stay_up() -> None:
    """MuJoCo sets an unstable one back to its start, where it would be found standing."""
    trials = draw_trials(0, range(3), int(model_spec(fingers=False).compile().nbody), dict.fromkeys(FACTORS, 0.0))
    crowd = Crowd(trials, threads=1)
    crowd.step(np.tile(HOME, (3, 1)))
    assert crowd.down().tolist() == [False, False, False]
    crowd.batch.bind("qvel")[1] = 1e12
    for _ in range(3):
        crowd.step(np.tile(HOME, (3, 1)))
        assert crowd.lost().tolist() == [False, True, False]
        assert crowd.down().tolist() == [False, True, False]
        assert np.isfinite(crowd.lean()).all()
