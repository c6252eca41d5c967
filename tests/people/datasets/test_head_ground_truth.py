"""Staged again, a shot says where the head is; it is there in the picture that was filmed."""

import numpy as np
import pytest

from nao_sim.people.datasets import dataset
from nao_sim.people.datasets.head_ground_truth import head_track, heads_of_film
from nao_sim.people.datasets.samples import sample_shot
from nao_sim.people.errors import FilmError
from nao_sim.resources import resource
from recognizer import open_clip
from recognizer.person.body_finder import BodyFinder
from recognizer.person.training.finder_training import train_ranking
from recognizer.person.training.known_heads import KnownHead
from recognizer.tracking import track_clip
from recognizer.video.samples import Sampler


@pytest.mark.parametrize("label", ["bye_right", "right_arm_rotation_ccw", "left_arm_pointing_left"])
def test_the_recogniser_finds_the_head_where_the_stage_has_it(stage, label):
    found = track_clip(open_clip(resource("assets", "clips", f"{label}.avi")))
    shot = sample_shot(label)
    x, y, head = np.median(head_track(stage, shot), axis=0) * found.samples[0].grey.shape[0]
    assert np.hypot(found.body.x - x, found.body.y - y) < 0.2 * head
    assert found.body.head == pytest.approx(head, rel=0.2)


def test_a_bow_lowers_the_head_and_makes_it_no_smaller(stage):
    track = head_track(stage, sample_shot("kowtow"))
    assert np.ptp(track[:, 1]) > 1.5 * track[0, 2]
    assert track[:, 2].min() > 0.95 * track[0, 2]


def test_a_film_is_staged_with_its_own_seed_and_restlessness(stage, tmp_path):
    jobs = dataset.plan(1, 1, 6, ["yes"], restless=1.0)
    dataset.film(jobs, tmp_path, processes=1)
    command = {"persons": 1, "takes": 1, "seed": 6, "classes": ["yes"], "irrelevant": 0, "restless": 1.0}
    dataset.write_card(tmp_path, command, jobs)
    (row, track), *more = heads_of_film(tmp_path)
    assert not more
    assert len(track) == row["frames"]
    assert np.allclose(track, head_track(stage, jobs[0].shot()))
    assert row["restless"] == 1.0


def test_the_ranking_is_learned_from_clips_with_known_heads(stage):
    heads = []
    for label in ("bye_right", "no", "kowtow"):
        clip = resource("assets", "clips", f"{label}.avi")
        heads.append(KnownHead(clip, label, head_track(stage, sample_shot(label))))
    told = []
    learnt = train_ranking(heads, told.append)
    finder = BodyFinder()
    sampler = Sampler(30.0)
    for frame in open_clip(heads[0].path):
        sample = sampler.push(frame)
        if sample is not None:
            finder.observe(sample)
    candidates, table = finder.candidates()
    best = candidates[int(np.argmax(learnt(table)))]
    true = heads[0].body(0, sampler.samples[0].grey.shape[0])
    assert np.hypot(best.x - true.x, best.y - true.y) < 0.35 * true.head
    assert len(told) == 1


@pytest.mark.parametrize("card", [None, "", "[]", '{"command": {"persons": 1, "seed": 6}}'])
def test_a_folder_that_does_not_say_how_it_was_filmed_is_named(tmp_path, card):
    if card is not None:
        (tmp_path / "card.json").write_text(card, encoding="utf-8")
    with pytest.raises(FilmError, match="film it again"):
        next(heads_of_film(tmp_path))
