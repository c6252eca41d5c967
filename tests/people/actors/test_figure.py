"""The figure: skin that hangs on its bodies, and persons of the stature they are drawn with."""

import mujoco
import numpy as np
import pytest

from nao_sim.people.actors.figure import Figure, parts, skeleton
from nao_sim.people.actors.persons import body_scales, draw_person


@pytest.fixture(scope="module")
def bare():
    figure, spec = Figure(), skeleton()
    figure.add_to(spec)
    return figure, spec.compile()


def posed_skin(model, name):
    """World vertices of a skin at rest, from the scene that would be drawn."""
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    scene = mujoco.MjvScene(model, maxgeom=10)
    everything = mujoco.mjtCatBit.mjCAT_ALL.value
    mujoco.mjv_updateScene(model, data, mujoco.MjvOption(), None, mujoco.MjvCamera(), everything, scene)
    skin = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SKIN, name)
    start = model.skin_vertadr[skin]
    return np.array(scene.skinvert).reshape(-1, 3)[start : start + model.skin_vertnum[skin]]


def test_every_vertex_hangs_on_bodies_with_full_weight():
    for part in parts():
        assert np.allclose(part.weights.sum(axis=1), 1.0)
        assert (np.count_nonzero(part.weights, axis=1) <= 8).all()
        assert part.faces.max() < len(part.vertices)


@pytest.mark.parametrize(("seed", "child"), [(0, True), (1, True), (2, False), (3, False), (4, False)])
def test_a_person_has_its_stature_and_stands_on_the_floor(bare, seed, child):
    figure, model = bare
    person = draw_person("p", np.random.default_rng(seed), child)
    figure.reshape(model, body_scales(person), {})
    top, sole = posed_skin(model, "head")[:, 2].max(), posed_skin(model, "shoe")[:, 2].min()
    assert person.is_child == child
    assert top == pytest.approx(person.stature, rel=0.04)
    assert abs(sole) < 0.012


def test_children_have_larger_heads_for_their_stature(bare):
    figure, model = bare
    shares = []
    for child in (True, False):
        person = draw_person("p", np.random.default_rng(5), child)
        figure.reshape(model, body_scales(person), {})
        head = posed_skin(model, "head")[:, 2]
        shares.append(np.ptp(head) / person.stature)
    assert shares[0] > 1.08 * shares[1]


def test_left_is_the_mirror_of_right(bare):
    figure, model = bare
    figure.reshape(model, {}, {})
    hand = posed_skin(model, "hand")
    right, left = hand[: len(hand) // 2], hand[len(hand) // 2 :]
    assert np.allclose(right * [1, -1, 1], left, atol=1e-6)


def test_cloth_lies_outside_the_skin(bare):
    figure, model = bare
    figure.reshape(model, {}, {})
    thin = np.ptp(posed_skin(model, "upper_sleeve"), axis=0)
    figure.reshape(model, {}, {"upper_sleeve": 0.015})
    thick = np.ptp(posed_skin(model, "upper_sleeve"), axis=0)
    assert (thick[:2] - thin[:2] > 0.015).all()
