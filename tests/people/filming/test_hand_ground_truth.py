"""Where a photo's hand is said to be: what is drawn of the person there is the hand, and it has the length said."""

from __future__ import annotations

import numpy as np
import pytest

from nao_sim.people.datasets.dataset import plan
from nao_sim.people.filming import photos
from nao_sim.people.filming.hand_ground_truth import known_hand
from nao_sim.people.filming.stage import Stage


@pytest.mark.parametrize("label", ["stop_hand", "pointing"])
def test_the_hand_is_drawn_where_and_as_large_as_it_is_said_to_be(label: str) -> None:
    shots = (job.photo() for job in plan(6, 4, 5, [label]))
    checked = 0
    with Stage(photos.DETAIL) as stage:
        for photo in [shot for shot in shots if not shot.close][:4]:
            known = known_hand(stage, photo)
            stage.set_size(photo.width, photo.height)
            stage.show_only(("hand",))
            stage.furnish(photo.room)
            stage.light(photo.light)
            stage.aim(photos.person_camera(photo, np.random.default_rng(photo.seed)))
            empty = stage.room_image()
            drawn = (stage.image(photo.angles).astype(int) - empty).any(axis=2)
            rows, columns = np.nonzero(drawn)
            away = np.hypot(columns - known.knuckle[0], rows - known.knuckle[1])
            hand = away < 0.75 * known.length
            assert away.min() < 0.1 * known.length
            reach = known.knuckle[1] - rows[hand].min()  # knuckle to fingertips is half of a hand
            assert 0.3 * known.length < reach < 0.75 * known.length
            assert known.neck[1] < photo.height
            checked += 1
    assert checked == 4
