"""What a pose adds to rest: edges where something came to, and their direction."""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from recognizer.features.body_features import blank
from recognizer.features.pose_features import levelled, new_edges
from recognizer.learning.mirror import mirrored
from recognizer.person.view import POSE

WIDTH, HEIGHT = POSE.size


@pytest.fixture
def room() -> np.ndarray:
    rng = np.random.default_rng(5)
    return cv2.GaussianBlur(rng.uniform(60, 160, (HEIGHT, WIDTH)).astype(np.float32), (0, 0), 3)


def with_arm(room: np.ndarray, start: tuple[int, int], end: tuple[int, int]) -> np.ndarray:
    picture = room.copy()
    cv2.line(picture, start, end, 230.0, 7, cv2.LINE_AA)
    return picture


def edges(before: np.ndarray, after: np.ndarray) -> np.ndarray:
    return new_edges(levelled(before), levelled(after))


def test_nothing_new_where_nothing_changed(room: np.ndarray) -> None:
    assert edges(room, room).max() == 0


def test_a_flat_part_under_a_rough_one_leaves_no_holes() -> None:
    # Running sums of squares end below 0 there for one picture in six.
    for seed in range(40):
        rng = np.random.default_rng(seed)
        picture = np.full((HEIGHT, WIDTH), 9.0, np.float32)
        rough = int(rng.integers(5, 60))
        picture[:rough] = rng.integers(30, 300, (rough, WIDTH)) / 3
        assert np.isfinite(levelled(picture)).all()


@pytest.mark.parametrize(
    ("end", "direction"),
    [((20, 70), 0), ((60, 30), 2), ((60, 70), 3), ((60, -10), 1)],  # hanging, level, and two slanting arms
)
def test_an_arm_shows_which_way_it_points(room: np.ndarray, end: tuple[int, int], direction: int) -> None:
    found = edges(room, with_arm(room, (20, 30), end))
    assert int(np.argmax(found.sum(axis=(1, 2)))) == direction


def test_edges_stand_where_the_arm_is(room: np.ndarray) -> None:
    found = edges(room, with_arm(room, (12, 20), (12, 60))).sum(axis=0)
    row, column = np.unravel_index(np.argmax(found), found.shape)
    assert column == 12 // (POSE.pixels // 2)
    assert 20 // (POSE.pixels // 2) <= row <= 60 // (POSE.pixels // 2)
    assert found[:, 7:].max() < 0.1 * found.max()


def test_mirrored_pictures_give_mirrored_features(room: np.ndarray) -> None:
    arm = with_arm(room, (20, 30), (50, 60))
    groups = {name: np.zeros(np.shape(values)) for name, values in blank()}
    turned = {name: values.copy() for name, values in groups.items()}
    groups["edges_hold"] = edges(room, arm)
    turned["edges_hold"] = edges(room[:, ::-1].copy(), arm[:, ::-1].copy())
    one, other = (np.concatenate([np.ravel(v) for v in g.values()]) for g in (groups, turned))
    np.testing.assert_allclose(mirrored(one[None])[0], other, atol=0.05)
