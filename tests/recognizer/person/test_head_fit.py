"""The fit of the head: from a rough place to the place itself, in drawings it learns from and in the sample clips;
and following it from sample to sample.
"""

from __future__ import annotations

import cv2
import numpy as np
import pytest

from nao_sim.resources import resource
from recognizer.person.head_fit import FARTHEST, fit, moved
from recognizer.person.head_follower import FARTHEST as FARTHEST_FOLLOWED
from recognizer.person.head_follower import HeadFollower, displacement
from recognizer.person.head_shoulders import Body, closer_look
from recognizer.person.training.head_fit_training import learn_fit
from recognizer.person.training.known_heads import KnownHead, Picture, pictures_of
from recognizer.tracking import track_clip
from recognizer.video.clip import open_clip


def drawing(rng: np.random.Generator, group: str) -> Picture:
    """A head on shoulders in front of blots."""
    grey = cv2.GaussianBlur(rng.uniform(0, 255, (240, 320)).astype(np.float32), (0, 0), 9)
    grey = cv2.normalize(grey, None, 60, 160, cv2.NORM_MINMAX)
    head = float(rng.uniform(24, 40))
    x, y = float(rng.uniform(120, 200)), float(rng.uniform(60, 110))
    shirt, face = rng.choice([20.0, 230.0], 2)
    outline = np.array([(-1.1, 4), (-1, 1), (-0.3, 0.6), (0.3, 0.6), (1, 1), (1.1, 4)]) * head + (x, y)
    cv2.fillPoly(grey, [outline.astype(np.int32)], shirt)
    cv2.ellipse(grey, ((x, y), (0.76 * head, head), 0), face, -1)
    return Picture(grey.astype(np.uint8), Body(x, y, head, 0.0), group)


def off(found: Body, true: Body) -> np.ndarray:
    """Distance and size error, in head heights and logarithm."""
    return np.array([np.hypot(found.x - true.x, found.y - true.y) / true.head, abs(np.log(found.head / true.head))])


def test_learns_to_find_drawn_heads_it_has_not_seen() -> None:
    rng = np.random.default_rng(5)
    told: list[str] = []
    steps = learn_fit([drawing(rng, f"p{k % 8}") for k in range(96)], rng, told.append)
    before, after = [], []
    for picture in (drawing(rng, "new") for _ in range(30)):
        right, down, larger = rng.uniform(-0.3, 0.3, 3)
        true = picture.body
        body = Body(true.x + right * true.head, true.y + down * true.head, true.head * np.exp(larger), 1.5)
        before.append(off(body, true))
        for weights, offset in steps:
            body = moved([body], closer_look(picture.grey, [body]), weights, offset)[0]
        after.append(off(body, true))
        assert body.score == 1.5
    assert np.all(np.median(after, axis=0) < 0.35 * np.median(before, axis=0))
    assert len(told) == len(steps) + 1


def test_a_step_goes_no_farther_than_half_a_head() -> None:
    cells = np.ones((1, 2800), np.float32)
    step = moved([Body(100, 50, 20, 0.0)], cells, np.full((2800, 3), 9.0, np.float32), np.zeros(3, np.float32))[0]
    assert (step.x, step.y) == (100 + FARTHEST * 20, 50 + FARTHEST * 20)
    assert step.head == pytest.approx(20 * np.exp(FARTHEST))


@pytest.mark.parametrize("clip", ["bye_right", "kowtow", "no", "right_arm_up"])
def test_rough_places_lead_to_the_same_head(clip: str) -> None:
    rng = np.random.default_rng(3)
    track = track_clip(open_clip(resource("assets", "clips", f"{clip}.avi")))
    grey, body = track.samples[0].grey, track.body
    best = fit(grey, fit(grey, body))
    ends = []
    for right, down, larger in rng.uniform(-0.25, 0.25, (12, 3)):
        rough = Body(best.x + right * best.head, best.y + down * best.head, best.head * np.exp(larger), 0.0)
        ends.append(off(fit(grey, rough), best))
    assert np.all(np.median(ends, axis=0) < 0.12)


def test_pictures_show_the_head_where_it_is_in_their_frame() -> None:
    path = resource("assets", "clips", "kowtow.avi")
    n = len(list(open_clip(path)))
    track = np.column_stack([np.linspace(0.2, 2.2, n), np.full(n, 0.4), np.full(n, 0.1)])
    pictures = pictures_of(KnownHead(path, "p000", track))
    height, width = pictures[0].grey.shape
    assert pictures[0].body.x == pytest.approx(0.2 * height)
    assert all(0 < picture.body.x < width for picture in pictures)
    assert len(pictures) == 2  # of three: then it has left the picture
    mirrored = pictures[1].mirrored()
    assert mirrored.body.x == pytest.approx(width - pictures[1].body.x)
    assert np.array_equal(mirrored.grey, pictures[1].grey[:, ::-1])


def test_the_follower_goes_where_the_picture_goes() -> None:
    track = track_clip(open_clip(resource("assets", "clips", "bye_right.avi")))
    grey, body = track.samples[0].grey, track.body
    follower = HeadFollower(body)
    start = follower.push(grey)
    for step in range(1, 9):
        shift = np.array([[1, 0, 0.08 * step * body.head], [0, 1, 0]], np.float32)
        now = follower.push(cv2.warpAffine(grey, shift, grey.shape[::-1], borderMode=cv2.BORDER_REPLICATE))
    assert now.head == body.head
    assert displacement(start, now)[0] == pytest.approx(0.64, abs=0.15)
    assert displacement(start, now)[1] == pytest.approx(0.0, abs=0.1)


def test_the_follower_stays_near_the_person() -> None:
    follower = HeadFollower(Body(160, 60, 30, 0.0))
    rng = np.random.default_rng(0)
    for _ in range(40):
        now = follower.push(rng.integers(0, 255, (240, 320)).astype(np.uint8))
        assert np.hypot(*displacement(follower.anchor, now)) <= FARTHEST_FOLLOWED + 1e-5
