"""Filming: the same pixels from the same seed, resumable, and a manifest that tells the truth."""

import hashlib
import json
from dataclasses import replace

import cv2
import numpy as np
import pytest

from nao_sim.people.datasets import dataset
from nao_sim.people.datasets.head_ground_truth import heads_of_film
from nao_sim.people.datasets.manifest import known_labels, read_manifest, write_manifest
from nao_sim.people.datasets.samples import head_and_hands, sample_labels, sample_photo, sample_shot
from nao_sim.people.errors import FilmError
from nao_sim.people.filming.avi_writer import AviWriter
from nao_sim.people.filming.camera import Camera
from nao_sim.people.filming.film import roll
from nao_sim.people.filming.photos import draw_photo, take_photo
from nao_sim.people.filming.rooms import BOX, Item
from nao_sim.people.filming.shots import COARSE, cameras, draw_cast, draw_shot
from nao_sim.people.filming.stage import Stage
from nao_sim.resources import resource

PERSONS = 3


def read(path):
    video, frames = cv2.VideoCapture(str(path)), []
    while True:
        got, frame = video.read()
        if not got:
            return np.array(frames), video.get(cv2.CAP_PROP_FPS)
        frames.append(frame)


@pytest.fixture(scope="module")
def small(gl, tmp_path_factory):
    out = tmp_path_factory.mktemp("film") / "set"
    jobs = dataset.plan(PERSONS, 1, 4, ["yes", "victory"], irrelevant=1)
    dataset.film(jobs, out, processes=1)
    dataset.write_card(out, {"seed": 4}, jobs)
    return out, jobs


def test_manifest_is_what_the_clips_are(small):
    out, jobs = small
    rows = read_manifest(out)
    assert [row["file"] for row in rows] == [job.file for job in jobs]
    for row in rows:
        if row["file"].endswith(".jpg"):
            assert cv2.imread(str(out / row["file"])).shape == (row["height"], row["width"], 3)
            continue
        frames, fps = read(out / row["file"])
        assert frames.shape == (row["frames"], row["height"], row["width"], 3)
        assert fps == pytest.approx(row["fps"], rel=1e-3)
        assert frames.std() > 5
    assert not list(out.rglob(".*"))
    card = json.loads((out / "card.json").read_text())
    assert card["clips"] == {"yes": PERSONS, "victory": PERSONS, "irrelevant": 1}


def test_an_interrupted_film_goes_on_and_gives_the_same_pixels(small):
    out, jobs = small
    before = {job.file: hashlib.sha256((out / job.file).read_bytes()).hexdigest() for job in jobs}
    kept = (out / jobs[1].file).stat().st_mtime_ns
    lost = [jobs[0], jobs[-1]]
    for job in lost:
        (out / job.file).unlink()
    stale = out / "yes" / ".p000_00.1.part.avi"
    stale.write_bytes(b"half")
    counted = []
    dataset.film(jobs, out, processes=1, done=counted.append)
    assert len(counted) == len(jobs)
    assert sum(count > 0 for count in counted) == len(lost)
    assert (out / jobs[1].file).stat().st_mtime_ns == kept
    assert not stale.exists()
    assert before == {job.file: hashlib.sha256((out / job.file).read_bytes()).hexdigest() for job in jobs}


def test_two_processes_give_the_same_pixels_as_one(small, tmp_path):
    out, jobs = small
    dataset.film(jobs[:2], tmp_path, processes=2)
    assert all((tmp_path / job.file).read_bytes() == (out / job.file).read_bytes() for job in jobs[:2])


def test_a_folder_with_another_film_is_left_alone(small):
    out, _ = small
    with pytest.raises(FilmError, match="choose another folder"):
        dataset.film(dataset.plan(1, 1, 5, ["yes"]), out, processes=1)
    with pytest.raises(FilmError, match="choose another folder"):
        dataset.film(dataset.plan(PERSONS, 1, 4, ["yes", "victory"], 1, restless=0.5), out, processes=1)
    assert not list(out.glob("yes/.*"))


def test_a_film_by_a_former_version_is_left_alone(small, tmp_path):
    out, jobs = small
    rows = [row | {"tables": "other ones"} for row in read_manifest(out)]
    write_manifest(tmp_path, rows)
    with pytest.raises(FilmError, match="former version"):
        dataset.film(jobs, tmp_path, processes=1)
    dataset.write_card(tmp_path, {"persons": PERSONS, "seed": 4, "restless": None}, jobs)
    with pytest.raises(FilmError, match="film it again"):
        next(heads_of_film(tmp_path))


def test_persons_and_shots_cover_what_is_promised():
    cast = draw_cast(0, 60)
    assert sum(person.is_child for person in cast) == 20
    statures = [person.stature for person in cast]
    assert 1.1 <= min(statures) < 1.2
    assert 1.85 < max(statures) <= 1.95
    brightness = [sum(person.skin) / 3 for person in cast]
    assert min(brightness) < 0.25
    assert max(brightness) > 0.75
    shots = [draw_shot(0, "bye_right", cast[k], 0) for k in range(60)]
    assert len({(shot.width, shot.height) for shot in shots}) >= 5
    assert {shot.framing for shot in shots} == set(cameras()["framing"])
    assert all(10 <= shot.fps <= 30 for shot in shots)
    assert len({shot.outfit.sleeves for shot in shots}) == 4


def test_the_person_is_in_the_picture_and_moves(stage):
    cast = draw_cast(9, 3)
    shot = draw_shot(9, "bye_two_hands", cast[2], 0)
    frames = np.array(list(roll(stage, shot))).astype(int)
    assert frames.shape == (shot.frames, shot.height, shot.width, 3)
    moved = np.abs(frames - np.median(frames, axis=0)).max(axis=(0, 3)) > 40
    assert 0.01 < moved.mean() < 0.6


def test_a_coarser_figure_looks_the_same_in_a_small_picture(stage):
    cast = draw_cast(9, 3)
    shot = next(
        shot
        for shot in (draw_shot(9, "bye_right", cast[1], take) for take in range(20))
        if shot.detail == COARSE and shot.framing == "half"
    )
    angles = shot.performance.angles(np.array([shot.performance.seconds / 2]))[0]
    shown = []
    with Stage(COARSE) as coarse:
        for one in (stage, coarse):
            one.set_size(shot.width, shot.height)
            one.cast(shot.person, shot.outfit)
            one.furnish(shot.room)
            one.light(shot.light)
            one.aim(shot.camera)
            room = one.room_image().astype(int)
            shown.append(np.abs(one.image(angles).astype(int) - room).max(axis=2) > 12)
        assert sum(len(p.faces) for p in coarse.figure.parts) < 0.65 * sum(len(p.faces) for p in stage.figure.parts)
    fine, rough = shown
    assert (fine & rough).sum() > 0.85 * (fine | rough).sum()


def test_large_pictures_show_the_fine_figure():
    shot = draw_shot(9, "bye_right", draw_cast(9, 3)[1], 0)
    assert replace(shot, height=960).detail == 1.0
    assert replace(shot, height=60).detail == COARSE


def test_the_floor_is_darker_under_the_feet(stage):
    shot = sample_shot("kowtow")
    camera = Camera((4.0, 0.0, 1.2), (0.0, 0.0, 0.8), 40.0)
    stage.set_size(160, 120)
    stage.cast(shot.person, shot.outfit)
    stage.furnish([Item(BOX, (0, 0, -0.1), (9, 9, 0.1), (0.6, 0.6, 0.6))])
    stage.light(shot.light)
    stage.aim(camera)
    room = stage.room_image().astype(int)
    picture = stage.image(shot.performance.base).astype(int)
    right, up = camera.project(np.array([0.26, 0.0, 0.0]))
    row, column = round(60 * (1 - up)), round(80 + 60 * right)
    assert (picture[row, column] < 0.95 * room[row, column]).all()
    assert (picture[:, :30] == room[:, :30]).all()


def test_samples_in_the_assets_are_what_the_command_makes(stage):
    folder = resource("assets", "clips")
    rows = {row["label"]: row for row in read_manifest(folder)}
    assert sorted(rows) == sorted(sample_labels())
    assert set(sample_labels()) == set(known_labels()) - {"irrelevant"}
    shown, _ = read(folder / rows["yes"]["file"])
    made = np.array(list(roll(stage, sample_shot("yes"))))
    assert shown.shape == made.shape
    # JPEG at low quality, and another version of Mesa, may differ by a little.
    assert np.abs(shown.astype(int) - made).mean() < 8


def test_samples_are_small_and_show_head_and_hands():
    folder = resource("assets", "clips")
    assert sum(path.stat().st_size for path in folder.iterdir()) < 620_000
    for label in sample_labels()[:4]:
        shot = sample_shot(label)
        places = shot.camera.project(head_and_hands(shot))
        assert (np.abs(places) <= [shot.width / shot.height, 1]).all(), label


def test_points_are_projected_to_where_they_are_rendered(stage):
    shot = sample_shot("right_arm_up")
    stage.set_size(shot.width, shot.height)
    stage.cast(shot.person, shot.outfit)
    stage.furnish(shot.room)
    stage.light(shot.light)
    stage.aim(shot.camera)
    room = stage.room_image().astype(int)
    angles = shot.performance.angles(np.array([shot.performance.seconds]))[0]
    person = np.abs(stage.image(angles).astype(int) - room).max(axis=2) > 8
    for body in ("head", "r_forearm", "pelvis", "l_hand"):
        right, up = shot.camera.project(stage.body_position(angles, body))
        row = round(shot.height / 2 * (1 - up))
        column = round(shot.width / 2 + shot.height / 2 * right)
        assert person[row - 1 : row + 2, column - 1 : column + 2].any(), body
    rows = np.flatnonzero(person.any(axis=1))
    tip = shot.camera.project(head_and_hands(shot)[-1])[:, 1].max()
    assert rows[0] == pytest.approx(shot.height / 2 * (1 - tip), abs=8)


def test_sample_photos_are_what_the_command_makes(stage):
    # Drawn on the coarser figure of the clips, which differs at the finger's outline only.
    photo = sample_photo("stop_hand")
    made = take_photo(stage, photo).astype(int)
    shown = cv2.imread(str(resource("assets", "clips", "stop_hand.jpg"))).astype(int)
    assert shown.shape == made.shape
    assert np.abs(shown - made).mean() < 12


def test_photos_show_a_hand_against_the_background(stage):
    person = draw_cast(3, 3)[2]
    for take in range(4):
        photo = draw_photo(3, "stop_hand", person, take)
        image = take_photo(stage, photo)
        assert image.shape == (photo.height, photo.width, 3)
        assert image.std() > 4


@pytest.mark.parametrize("fps", [10, 29.97, 24])
def test_avi_keeps_frames_and_rate(tmp_path, fps):
    rng = np.random.default_rng(0)
    frames = [cv2.resize(rng.integers(0, 255, (3, 4), dtype=np.uint8), (64, 48)) for _ in range(9)]
    frames = [np.repeat(frame[:, :, None], 3, axis=2) for frame in frames]
    with AviWriter(tmp_path / "a.avi", 64, 48, fps, 95) as writer:
        for frame in frames:
            writer.write(frame)
    shown, rate = read(tmp_path / "a.avi")
    assert rate == pytest.approx(fps, rel=1e-3)
    assert np.abs(shown.astype(int) - np.array(frames)).mean() < 4
    assert [path.name for path in tmp_path.iterdir()] == ["a.avi"]


def test_an_interrupted_avi_leaves_nothing(tmp_path):
    def interrupted():
        with AviWriter(tmp_path / "a.avi", 64, 48, 10, 90) as writer:
            writer.write(np.zeros((48, 64, 3), np.uint8))
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        interrupted()
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(
    ("arguments", "text"),
    [
        ((0, 1, 0), "at least one person"),
        ((1, 0, 0), "one take"),
        ((1, 1, 0, ["wave"]), "known: "),
        ((1, 1, 0, None, 0, 1.2), "0 to 1"),
    ],
)
def test_plans_that_cannot_be_filmed_say_why(arguments, text):
    with pytest.raises(FilmError, match=text):
        dataset.plan(*arguments)


def test_frame_sizes_beyond_the_renderer_are_refused(stage):
    with pytest.raises(FilmError, match="4000x3000"):
        stage.set_size(4000, 3000)
