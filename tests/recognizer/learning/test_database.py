from __future__ import annotations

import dataclasses
from pathlib import Path

import numpy as np
import pyarrow as pa
import pyarrow.parquet as pq
import pytest

from recognizer import Database, DatabaseError, Recognizer
from recognizer.evaluation.cross_validation import evaluate
from recognizer.features.body_features import METHOD, VERSION, names
from recognizer.learning.body_model import BodyModel
from recognizer.learning.mirror import mirrored, twins
from recognizer.learning.person_folds import KnownRows

MIRROR = {"bye_right": "bye_left", "bye_left": "bye_right", "right_arm_up": "left_arm_up", "kowtow": "kowtow"}
FAMILY = {"bye_right": "small", "right_arm_up": "large", "kowtow": "large", "irrelevant": "irrelevant"}


def database(persons: int = 6, labels: tuple[str, ...] = tuple(FAMILY), takes: int = 2) -> Database:
    """Random vectors around a centre for each label; each person has an offset of its own."""
    rng = np.random.default_rng(0)
    rows = [(label, f"p{person}") for person in range(persons) for label in labels for _ in range(takes)]
    centre = {label: rng.normal(0, 1, len(names())) for label in labels}
    offset = {f"p{person}": rng.normal(0, 0.3, len(names())) for person in range(persons)}
    features = [centre[label] + offset[person] + rng.normal(0, 0.3, len(names())) for label, person in rows]
    label, person = (np.array(column) for column in zip(*rows, strict=True))
    return Database(
        np.array(features, np.float32),
        label,
        np.array([FAMILY[x] for x in label]),
        np.where(label == "irrelevant", "clap", label),
        person,
        np.array([f"{i}.avi" for i in range(len(rows))]),
        names(),
        METHOD,
        VERSION,
        MIRROR,
        {"seed": 0},
    )


def test_round_trip(tmp_path: Path) -> None:
    made = database()
    made.save(tmp_path / "d.parquet")
    read = Database.load(tmp_path / "d.parquet")
    low, high = np.quantile(made.features, [0.005, 0.995], axis=0)
    np.testing.assert_allclose(read.features, made.features.clip(low, high), atol=(high - low).max() / 15)
    for name in ("labels", "families", "actions", "persons", "sources"):
        assert getattr(read, name).tolist() == getattr(made, name).tolist()
    assert (read.names, read.method, read.version) == (made.names, METHOD, VERSION)
    assert (read.mirror, read.provenance) == (MIRROR, {"seed": 0})
    assert [p.name for p in tmp_path.iterdir()] == ["d.parquet"]


def test_a_stored_model_answers_as_the_one_that_was_learned(tmp_path: Path) -> None:
    learned = Recognizer.fit(database())
    learned.save(tmp_path / "d.parquet")
    read = Recognizer.load(tmp_path / "d.parquet")
    for vector in learned.database.features[:6]:
        a, b = learned.decide(vector), read.decide(vector)
        assert a.label == b.label
        assert a.distance == pytest.approx(b.distance, rel=0.1, abs=0.1)
        assert a.threshold == b.threshold


def test_damaged_and_foreign_files_are_refused(tmp_path: Path) -> None:
    good = tmp_path / "good.parquet"
    database(2).save(good)
    (tmp_path / "cut.parquet").write_bytes(good.read_bytes()[:-500])
    (tmp_path / "text.parquet").write_text("no parquet")
    pq.write_table(pa.table({"a": [1]}), tmp_path / "foreign.parquet")
    for name in ("cut", "text", "foreign"):
        with pytest.raises(DatabaseError, match="not a feature database"):
            Database.load(tmp_path / f"{name}.parquet")
    with pytest.raises(DatabaseError, match="no such database"):
        Database.load(tmp_path / "absent.parquet")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"version": 99}, "version 99"),
        ({"method": "magic"}, "method 'magic'"),
        ({"names": tuple(f"f{i}" for i in range(len(names())))}, "train it again"),
    ],
)
def test_other_features_are_refused(change: dict[str, object], words: str) -> None:
    with pytest.raises(DatabaseError, match=words):
        Recognizer(dataclasses.replace(database(2), **change))  # type: ignore[arg-type]


def test_not_finite_and_empty_are_refused() -> None:
    made = database(2)
    broken = made.features.copy()
    broken[3, 5] = np.nan
    with pytest.raises(DatabaseError, match=r"row 3 .*3\.avi"):
        dataclasses.replace(made, features=broken)
    with pytest.raises(DatabaseError, match="no rows"):
        made.take(np.zeros(len(made), bool))


@pytest.mark.parametrize(
    ("persons", "labels"), [(1, tuple(FAMILY)), (3, ("bye_right",)), (3, ("bye_right", "kowtow")), (1, ("kowtow",))]
)
def test_small_databases_still_answer(persons: int, labels: tuple[str, ...]) -> None:
    made = database(persons, labels)
    recognizer = Recognizer.fit(dataclasses.replace(made, mirror={}))
    for vector, label in zip(made.features, made.labels, strict=True):
        if label != "irrelevant":
            assert recognizer.decide(vector).nearest == label


def test_context_narrows_and_unknown_names_are_refused() -> None:
    recognizer = Recognizer.fit(database())
    vector = recognizer.database.features[recognizer.database.labels == "bye_right"][0]
    assert recognizer.decide(vector).nearest == "bye_right"
    assert recognizer.decide(vector, {"kowtow"}).nearest == "kowtow"
    with pytest.raises(DatabaseError, match="unknown gesture bye_bye"):
        recognizer.allowed(["bye_bye"])


def test_irrelevant_motion_is_rejected_and_named() -> None:
    made = database()
    decision = Recognizer.fit(made).decide(made.features[made.labels == "irrelevant"][0])
    assert decision.rejected
    assert decision.label is None
    assert "clap" in decision.reason


def test_mirroring_twice_is_nothing_and_rows_get_their_twins() -> None:
    made = database(2)
    np.testing.assert_allclose(mirrored(mirrored(made.features)), made.features)
    rows = twins(made)
    assert dict(zip(made.labels.tolist(), rows.labels.tolist(), strict=True)) == {
        "bye_right": "irrelevant",
        "right_arm_up": "irrelevant",
        "kowtow": "kowtow",
        "irrelevant": "irrelevant",
    }
    assert {"left_arm_up", "bye_left", "clap"} < set(rows.actions.tolist())


def test_an_irrelevant_motion_that_is_a_twin_becomes_the_gesture_in_the_mirror() -> None:
    made = database(2)
    rows = twins(dataclasses.replace(made, actions=np.where(made.labels == "irrelevant", "left_arm_up", made.actions)))
    turned = made.labels == "irrelevant"
    assert set(rows.labels[turned].tolist()) == {"right_arm_up"}
    assert set(rows.families[turned].tolist()) == {"large"}
    assert set(rows.actions[made.labels == "right_arm_up"].tolist()) == {"left_arm_up"}


def test_an_irrelevant_motion_named_like_a_gesture_stays_irrelevant_in_the_mirror() -> None:
    made = database(2)
    rows = twins(dataclasses.replace(made, actions=np.where(made.labels == "irrelevant", "kowtow", made.actions)))
    assert set(rows.labels[made.labels == "irrelevant"].tolist()) == {"irrelevant"}


def test_rounding_twice_is_rounding_once_and_what_is_read_back(tmp_path: Path) -> None:
    rng = np.random.default_rng(1)
    made = database(30, takes=8)
    outliers = made.features.copy()
    outliers[rng.integers(0, len(made), made.features.shape[1]), np.arange(made.features.shape[1])] = 99
    made = dataclasses.replace(made, features=outliers, bits=4)
    once = made.rounded()
    np.testing.assert_allclose(once.rounded().features, once.features, rtol=1e-5, atol=1e-5)
    once.save(tmp_path / "d.parquet")
    np.testing.assert_allclose(Database.load(tmp_path / "d.parquet").features, once.features, rtol=1e-5, atol=1e-5)
    assert np.abs(once.features).max() < 10  # 16 steps are not spent on one value of 960


def test_evaluation_never_shows_a_person_to_its_judge(monkeypatch: pytest.MonkeyPatch) -> None:
    made = database(4)
    fitted: list[set[str]] = []
    original = BodyModel._learn

    def spy(self: BodyModel, known: KnownRows, used: np.ndarray) -> BodyModel:
        fitted.append(set(known.database.persons[used].tolist()))
        return original(self, known, used)

    monkeypatch.setattr(BodyModel, "_learn", spy)
    result = evaluate(made)
    assert [len(persons) for persons in fitted] == [3, 3, 3, 3]
    assert result.score() == 1.0
    assert result.summary()["routing"] == 1.0
    assert result.rejections()["clap"][:2] == (8, 1.0)
    assert result.rejections()["kowtow"] == (
        8,
        pytest.approx(result.rejected[made.labels == "kowtow"].mean()),
        "kowtow",
    )
    labels, counts = result.confusion("large")
    assert labels == ["kowtow", "right_arm_up"]
    assert counts.trace() == 16


def test_what_a_former_version_learned_is_learned_anew(tmp_path: Path) -> None:
    made = database(4)
    learned = BodyModel().fit(made)
    former = {k: v for k, v in learned.arrays.items() if not k.startswith("linear")} | {"coefficients": np.eye(3)}
    dataclasses.replace(made, arrays=former).save(tmp_path / "former.parquet")
    back = BodyModel().fit(Database.load(tmp_path / "former.parquet"))
    assert back.limit_ == pytest.approx(learned.limit_, rel=0.05)


@pytest.mark.parametrize(("persons", "network"), [(4, False), (12, True)])
def test_few_rows_are_weighed_without_a_network(monkeypatch: pytest.MonkeyPatch, persons: int, network: bool) -> None:
    monkeypatch.setattr("recognizer.learning.body_model.MANY", 60)
    model = BodyModel().fit(database(persons))
    assert (model.weights_.network is not None) == network
    assert np.isfinite(model.limit_)


@pytest.mark.parametrize("protocol", ["k-fold", "loo-person"])
def test_protocols(protocol: str) -> None:
    assert evaluate(database(3), protocol).score() > 0.9


def test_several_processes_answer_as_one(monkeypatch: pytest.MonkeyPatch) -> None:
    made = database(4)
    shown: list[int] = []
    alone = evaluate(made)
    monkeypatch.delattr(BodyModel, "_learn")  # in this process; others know nothing of it
    both = evaluate(made, progress=lambda done, _: shown.append(done), jobs=2)
    assert shown == [1, 2, 3, 4]
    for field in dataclasses.fields(alone):
        np.testing.assert_array_equal(getattr(alone, field.name), getattr(both, field.name))


def test_protocols_say_what_they_need() -> None:
    with pytest.raises(DatabaseError, match="two persons"):
        evaluate(database(1))
    with pytest.raises(DatabaseError, match="unknown protocol"):
        evaluate(database(2), "leave-none-out")
