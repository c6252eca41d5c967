"""Limbs meet where real ones would, and nowhere else."""

from __future__ import annotations

import mujoco
import numpy as np
import pytest
from scipy.stats import qmc

from nao_sim.robot import ACTUATED, Nao, joint_table, postures

LOW, HIGH = joint_table().select(ACTUATED).range_rad().T


def _self_contacts(nao: Nao) -> dict[tuple[str, str], float]:
    model, found = nao.model, {}
    for contact in nao.data.contact:
        first, second = (model.body(model.geom_bodyid[g]).name for g in contact.geom)
        if "world" not in (first, second):
            found[first, second] = contact.dist
    return found


@pytest.mark.parametrize("name", list(postures()))
def test_official_postures_touch_nothing_of_themselves(name: str, standing: Nao) -> None:
    standing.reset(name)
    assert [pair for pair, distance in _self_contacts(standing).items() if distance < 0] == []


@pytest.mark.parametrize("side", ["L", "R"])
@pytest.mark.parametrize("height", [0.3, 0.6, 0.9, 1.2])
def test_a_hand_cannot_enter_the_torso(side: str, height: float, hung: Nao) -> None:
    """Elbow bent fully inwards at several heights: the hand stops at the chest, shell outside shell."""
    sign = 1 if side == "L" else -1
    hung.reset("StandZero")
    hung.set_angles(f"{side}Arm", [height, 0.0, 0.0, -sign * 1.57, 0.0, 0.0])
    hung.step(40)
    hung.set_angles(f"{side}ShoulderPitch", 2.0)
    hung.step(60)
    deepest = min(_self_contacts(hung).values(), default=0.0)
    assert deepest > -4e-3
    box = _chest_depth(hung, f"{side.lower()}_hand")
    assert box < 0.004


def _chest_depth(nao: Nao, hand: str) -> float:
    """How deep the middle of the palm's shell is inside the chest's ellipsoid, metres; negative outside."""
    data, model = nao.data, nao.model
    torso = data.body("torso")
    palm = data.body(hand).xpos + data.body(hand).xmat.reshape(3, 3) @ [0.042, 0, 0]
    local = torso.xmat.reshape(3, 3).T @ (palm - torso.xpos) - [-0.002, 0, 0.064]
    reach = np.linalg.norm(local / [0.050, 0.072, 0.062])
    assert model.nbody > 20
    return float((1 - reach) * 0.05)


def test_self_contact_stays_shallow_in_random_poses(hung: Nao) -> None:
    hung.reset("StandZero")
    deepest = 0.0
    for point in qmc.Halton(25, seed=8).random(30):
        hung.set_targets(LOW + point * (HIGH - LOW))
        hung.step(40)
        deepest = min([deepest, *_self_contacts(hung).values()])
    assert -0.006 < deepest < 0


def test_soles_do_not_catch_on_each_other_but_feet_meet(hung: Nao) -> None:
    hung.reset("StandZero")
    hung.set_angles(["LHipRoll", "RHipRoll"], [-0.35, 0.35])
    hung.step(60)
    touching = {frozenset(pair) for pair in _self_contacts(hung)}
    legs = [pair for pair in touching if {name[2:] for name in pair} <= {"foot", "tibia", "thigh"}]
    assert legs
    left, right = (hung.data.body(f"{s}_foot").xpos[1] for s in "lr")
    assert left - right > 0.03


def test_neighbours_in_a_chain_never_collide(model: mujoco.MjModel) -> None:
    data = mujoco.MjData(model)
    rng = np.random.default_rng(2)
    low, high = joint_table().range_rad().T
    from nao_sim.robot.placement import set_joints

    for _ in range(200):
        data.qpos[2] = 2
        set_joints(model, data, rng.uniform(low, high))
        mujoco.mj_fwdPosition(model, data)
        for contact in data.contact:
            a, b = (int(model.geom_bodyid[g]) for g in contact.geom)
            assert model.body_parentid[a] != b
            assert model.body_parentid[b] != a
