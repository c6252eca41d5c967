from __future__ import annotations

import csv
import dataclasses
from pathlib import Path

import cv2
import numpy as np
import pytest
from sklearn.utils.estimator_checks import parametrize_with_checks

from recognizer.errors import ClipError, DatabaseError, RecognizerError
from recognizer.evaluation.dataset import Entry
from recognizer.postures import PhotoRecognizer, learn_from_photos, recognize_photo
from recognizer.postures.errors import NoSkinError, PhotoError
from recognizer.postures.explain import explain_photo
from recognizer.postures.learning.posture_model import PostureClassifier
from recognizer.postures.learning.training import learn_from_model_hand
from recognizer.postures.photo import as_bgr, read_photo

from .conftest import hand_photo, unseen_hands

LABELS = ("round", "pointing", "victory", "three", "four", "stop_hand", "perfect")
DIGITS = dict(zip("0123459", ("round", "pointing", "victory", "three", "four", "stop_hand", "perfect"), strict=True))


@parametrize_with_checks([PostureClassifier(n_neighbors=1)])
def test_posture_classifier_keeps_the_contract_of_scikit_learn(estimator, check):
    check(estimator)


def test_unseen_model_hands_are_named(recognizer):
    right = {
        name: np.mean([recognizer.recognize(hand_photo(mask)).nearest == name for mask in unseen_hands(name, 5)])
        for name in LABELS
    }
    assert np.mean(list(right.values())) >= 0.8, right


def test_learning_is_reproducible():
    a, b = (learn_from_model_hand(persons=2, takes=1, seed=9) for _ in range(2))
    assert (a.features == b.features).all()
    assert (a.labels == b.labels).all()
    assert a.provenance["seed"] == 9


def test_a_mirrored_brighter_larger_photo_gets_the_same_answer(recognizer):
    same = []
    for name in ("stop_hand", "victory", "round"):
        mask = unseen_hands(name, 1, seed=11)[0]
        photo = hand_photo(mask)
        variants = [
            np.ascontiguousarray(photo[:, ::-1]),
            np.clip(photo * 1.15, 0, 255).astype(np.uint8),
            cv2.resize(photo, (800, 800), interpolation=cv2.INTER_CUBIC),
            np.dstack([photo, np.full(photo.shape[:2], 255, np.uint8)]),
        ]
        base = recognizer.recognize(photo).nearest
        same += [recognizer.recognize(v).nearest == base for v in variants]
    assert np.mean(same) >= 0.9, same


@pytest.mark.parametrize("skin", [(40, 55, 80), (170, 190, 225)])
def test_dark_and_bright_skin_get_the_answer_of_medium_skin(recognizer, skin):
    for name in ("stop_hand", "victory"):
        mask = unseen_hands(name, 1, seed=2)[0]
        medium = recognizer.recognize(hand_photo(mask))
        assert recognizer.recognize(hand_photo(mask, skin=skin)).nearest == medium.nearest == name


def test_grey_photo_is_read_through_its_background(recognizer):
    photo = hand_photo(unseen_hands("victory", 1, seed=2)[0])
    grey = cv2.cvtColor(photo, cv2.COLOR_BGR2GRAY)
    assert recognizer.recognize(grey).nearest == recognizer.recognize(photo).nearest == "victory"


def test_recognition_carries_its_reasons(recognizer, database):
    photo = hand_photo(unseen_hands("stop_hand", 1, seed=21)[0])
    answer = recognize_photo(photo, database, source="desk")
    assert answer.family == "static"
    assert answer.source == "desk"
    assert answer.method == "static"
    assert answer.distance <= answer.threshold
    assert sum(answer.votes.values()) == pytest.approx(1)
    assert answer.neighbours[0].source.startswith("model hand")
    assert answer.to_dict()["label"] == answer.label
    assert recognizer.recognize(photo, among=["stop_hand", "four"]).label in ("stop_hand", "four")


def test_an_unknown_context_is_refused(recognizer):
    with pytest.raises(DatabaseError, match="unknown posture waving; known: four"):
        recognizer.recognize(np.zeros((100, 100, 3), np.uint8), among=["waving"])


def test_a_face_beside_the_hand_does_not_matter_and_two_hands_are_announced(recognizer):
    hand = unseen_hands("stop_hand", 1, seed=21)[0]
    scene = np.zeros((220, 420), bool)
    scene[20:220, :200] = hand
    y, x = np.mgrid[:220, :420]
    with_face = scene | (((x - 310) / 38) ** 2 + ((y - 90) / 52) ** 2 < 1)
    assert recognizer.recognize(hand_photo(with_face)).nearest == "stop_hand"
    both = scene.copy()
    both[20:220, 220:] = hand[:, ::-1]
    answer = recognizer.recognize(hand_photo(both))
    assert answer.nearest == "stop_hand"
    assert any("2 hands in view" in warning for warning in answer.warnings)


def test_no_skin_and_nothing_else(recognizer):
    noise = np.random.default_rng(0).normal(128, 1, (120, 160, 3)).astype(np.uint8)
    with pytest.raises(NoSkinError, match="background"):
        recognizer.recognize(noise)


def test_bad_pictures(tmp_path, recognizer):
    broken = tmp_path / "broken.jpg"
    broken.write_bytes(b"not a picture")
    empty = tmp_path / "empty.png"
    empty.write_bytes(b"")
    for path in (broken, empty, tmp_path / "absent.jpg", tmp_path):
        with pytest.raises(PhotoError, match=path.name):
            read_photo(path)
    with pytest.raises(PhotoError, match="32x32"):
        as_bgr(np.zeros((8, 300, 3), np.uint8))
    with pytest.raises(PhotoError, match="megapixels"):
        as_bgr(np.broadcast_to(np.zeros((1, 1, 3), np.uint8), (20_000, 20_000, 3)))
    with pytest.raises(PhotoError, match="shape"):
        as_bgr(np.zeros((50, 50, 2), np.uint8))
    with pytest.raises(PhotoError, match="type"):
        as_bgr(np.zeros((50, 50, 3), np.float32))
    assert issubclass(PhotoError, ClipError)
    assert issubclass(ClipError, RecognizerError)


def test_odd_formats_become_bgr(tmp_path):
    photo = hand_photo(unseen_hands("four", 1)[0])
    cv2.imwrite(str(tmp_path / "deep.png"), photo.astype(np.uint16) * 257)
    assert np.abs(read_photo(tmp_path / "deep.png").astype(int) - photo).max() <= 1
    clear = np.dstack([photo, np.zeros(photo.shape[:2], np.uint8)])
    assert (as_bgr(clear) == 255).all()


def test_a_database_of_another_version_or_kind_is_refused(database):
    with pytest.raises(DatabaseError, match="version"):
        PhotoRecognizer(dataclasses.replace(database, version=99))
    with pytest.raises(DatabaseError, match="photos"):
        PhotoRecognizer(dataclasses.replace(database, method="dynamic"))


def test_saved_and_loaded_it_answers_the_same(tmp_path, database, recognizer):
    database.save(tmp_path / "static.parquet")
    loaded = PhotoRecognizer.load(tmp_path / "static.parquet")
    for name in ("three", "perfect"):
        photo = hand_photo(unseen_hands(name, 1, seed=4)[0])
        a, b = recognizer.recognize(photo), loaded.recognize(photo)
        assert a.nearest == b.nearest
        assert b.distance == pytest.approx(a.distance, rel=1e-3)  # stored in 16 bits


@pytest.mark.parametrize("method", ["static", "thesis_static"])
def test_learning_from_a_folder_of_photos(tmp_path, method):
    entries = []
    for name in ("stop_hand", "pointing"):
        for take, mask in enumerate(unseen_hands(name, 6, seed=8)):
            path = tmp_path / f"{name}_{take}.png"
            cv2.imwrite(str(path), hand_photo(mask))
            entries.append(Entry(path, path.name, name, name, f"p{take}"))
    blank = tmp_path / "blank.png"
    cv2.imwrite(str(blank), np.full((100, 100, 3), 200, np.uint8))
    entries.append(Entry(blank, "blank.png", "pointing", "pointing", "p9"))
    learnt = learn_from_photos(entries, method)
    assert len(learnt) == 12
    assert learnt.provenance["without_a_hand"] == ["blank.png"]
    recognizer = PhotoRecognizer(learnt)
    named = [recognizer.recognize(entry.path).nearest == entry.label for entry in entries[:12]]
    assert np.mean(named) >= 0.9  # the very photos it has learnt


def test_explain_writes_every_stage(tmp_path, recognizer):
    paths = explain_photo(hand_photo(unseen_hands("victory", 1, seed=2)[0]), recognizer, tmp_path)
    names = [path.stem[3:] for path in paths]
    for stage in ("gray_world", "skin", "chamfer_distance", "feature_pixels_and_cut", "smoothed_contour", "candidates"):
        assert stage in names
    assert all(cv2.imread(str(path)).std() > 1 for path in paths)


def test_shipped_database_on_real_photos_of_a_few_persons(real_photos: Path):
    shipped = PhotoRecognizer.load(Path(__file__).resolve().parents[3] / "assets" / "databases" / "static.parquet")
    rows = [
        row
        for row in csv.DictReader((real_photos / "labels.csv").read_text().splitlines())
        if int(row["person"][1:]) % 25 == 1 and row["digit"] in DIGITS
    ]
    right = [shipped.recognize(real_photos / row["file"]).label == DIGITS[row["digit"]] for row in rows]
    assert np.mean(right) >= 0.8, f"{np.mean(right):.2f} of {len(right)}"
