"""What a user may import, and how it answers."""

from __future__ import annotations

import doctest

import numpy as np
import pytest

import nao_sim
from nao_sim import robot
from nao_sim.robot import CHAINS, Nao, nao


def test_nao_is_exported_lazily() -> None:
    assert nao_sim.Nao is Nao
    with pytest.raises(AttributeError, match="has no attribute 'Noa'"):
        _ = nao_sim.Noa


def test_everything_public_exists() -> None:
    assert len(robot.__all__) == len(set(robot.__all__))
    for name in robot.__all__:
        assert getattr(robot, name) is not None


def test_the_documented_example_is_true() -> None:
    assert doctest.testmod(nao).failed == 0


def test_arrays_have_one_value_a_motor(standing: Nao) -> None:
    standing.reset("Stand")
    standing.step(2)
    for values in (standing.angles, standing.velocities, standing.torques, standing.targets, standing.setpoint):
        assert values.shape == (25,)
        assert values.dtype == np.float64
    assert standing.torso_pose.shape == (7,)
    assert np.linalg.norm(standing.torso_pose[3:]) == pytest.approx(1)
    assert standing.time == pytest.approx(2 * standing.control_period)


def test_hands_open_and_close(hung: Nao) -> None:
    def reach(opening: float) -> float:
        hung.reset("StandZero")
        hung.set_angles(["LHand", "RHand"], opening)
        hung.step(40)
        assert hung.angles[[7, 24]] == pytest.approx([opening, opening], abs=0.02)
        tip = hung.data.body("l_fingertips")
        return float(tip.xpos[0] + 0.02 * tip.xmat.reshape(3, 3)[0, 0] - hung.data.body("l_hand").xpos[0])

    assert reach(1.0) > reach(0.5) > reach(0.0)


def test_fingers_follow_their_hand(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles("LHand", 0.7)
    hung.step(40)
    for part in ("LFingertips", "LThumb"):
        assert hung.data.joint(part).qpos[0] == pytest.approx(hung.data.joint("LHand").qpos[0], abs=0.01)


def test_chains_partition_the_body() -> None:
    parts = [name for chain in ("Head", "LArm", "RArm", "LLeg", "RLeg") for name in CHAINS[chain]]
    assert sorted(parts) == sorted(CHAINS["Body"])
