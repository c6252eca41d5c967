"""A hand that waves and one that is held up differ in what keeps changing, and how often."""

from __future__ import annotations

import numpy as np

from recognizer.features.change_features import unrest_features
from recognizer.features.phases import Active
from recognizer.person.view import WHOLE

WIDTH, HEIGHT = WHOLE.size
PERIOD = 0.1


def held_up(beats: float, column: int = 14, seconds: float = 4.0) -> Active:
    """A bright patch that swings about a place ``beats`` times a second; 0 keeps still."""
    n = round(seconds / PERIOD)
    pictures = np.zeros((n, HEIGHT, WIDTH), np.float32)
    for k in range(n):
        x = column + round(3 * np.sin(2 * np.pi * beats * k * PERIOD))
        pictures[k, 20:26, x : x + 4] = 40.0
    none = np.zeros((n, HEIGHT, WIDTH), np.float32)
    seconds_each = np.full(n, PERIOD, np.float32)
    return Active(
        none, none, none, none, none, none, pictures, none, none, seconds_each, 0, n, np.zeros((5, n)), 1.0
    )  # fmt: skip


def test_only_what_moves_is_restless() -> None:
    still, waved = (dict(unrest_features(held_up(beats))) for beats in (0.0, 1.2))
    assert np.abs(still["unrest"]).max() < 1e-5
    row, column = np.unravel_index(np.argmax(waved["unrest"]), waved["unrest"].shape)
    assert (row, column) in {(20 // 4 + r, 14 // 4 + c) for r in (0, 1) for c in (-1, 0, 1)}


def test_how_often_is_seen_on_the_side_where_it_is() -> None:
    for beats, band in ((0.6, 0), (1.2, 1), (2.0, 2)):
        found = dict(unrest_features(held_up(beats)))
        assert found["flicker_right"][4] > found["flicker_left"][4] + 0.3
        shares = found["flicker_right"][:4]
        assert int(np.argmax(shares[: band + 1])) == band  # twice as often is the patch's coming and going
        assert shares[band] > 0.25


def test_the_other_side_gives_the_mirror_image() -> None:
    right, left = (dict(unrest_features(held_up(1.2, column))) for column in (14, WIDTH - 18))
    np.testing.assert_allclose(right["unrest"], left["unrest"][:, ::-1], atol=0.08)
    np.testing.assert_allclose(right["flicker_right"], left["flicker_left"], atol=0.05)
