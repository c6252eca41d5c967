"""The shipped database is what its documented film gives: some of its clips are filmed again and described again."""

from pathlib import Path

import numpy as np
import pytest

from nao_sim.people.datasets.dataset import Job, film, plan
from nao_sim.resources import resource
from recognizer.evaluation.dataset import build_database, read_manifest
from recognizer.learning.database import Database

LABELS = ("bye_right", "kowtow", "no", "irrelevant")


@pytest.fixture(scope="module")
def shipped() -> Database:
    return Database.load(resource("assets", "databases", "dynamic.parquet"))


def cheapest(jobs: list[Job], label: str) -> Job:
    """Of the first clips of a label, the one with the fewest pixels to render."""
    shots = [(job, job.shot()) for job in jobs if job.label == label][:6]
    return min(shots, key=lambda pair: pair[1].width * pair[1].height * pair[1].frames)[0]


def test_clips_filmed_again_give_the_rows_of_the_database(shipped: Database, gl: None, tmp_path: Path) -> None:
    command = shipped.provenance["card"]["command"]
    asked = ("persons", "takes", "seed", "classes", "irrelevant", "restless")
    jobs = plan(*(command[name] for name in asked))
    assert {job.file for job in jobs} == set(shipped.sources.tolist())
    film([cheapest(jobs, label) for label in LABELS], tmp_path, 1, lambda frames: None)
    families = dict(zip(shipped.labels.tolist(), shipped.families.tolist(), strict=True))
    again, problems = build_database(read_manifest(tmp_path), families, "body", jobs=1)
    assert problems == []
    rows = [shipped.sources.tolist().index(source) for source in again.sources]
    stored = shipped.take(np.array(rows))
    assert stored.actions.tolist() == again.actions.tolist()
    spread = shipped.features.std(axis=0) + 1e-3
    # Another renderer draws a little differently; another person or motion is 1 apart.
    assert np.abs((stored.features - again.features) / spread).mean() < 0.15
