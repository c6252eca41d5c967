"""From labelled clips to a database that names, and what a user is told of one person's clips."""

from __future__ import annotations

import csv
import json
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.cli.conftest import Ran

LABELS = ("bye_right", "yes", "kowtow")


@pytest.mark.parametrize("persons", [1, 2])
def test_a_folder_of_clips_becomes_a_database(
    nao_sim: Callable[..., Ran], sample_clips: Path, tmp_path: Path, persons: int
) -> None:
    with (tmp_path / "manifest.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(("file", "label", "person"))
        for person in range(persons):
            rows.writerows((sample_clips / f"{label}.avi", label, f"p{person}") for label in LABELS)
    trained = nao_sim("train", tmp_path, "--out", tmp_path / "own.parquet", "--jobs", 1)
    assert trained.code == 0
    assert ("nothing will be rejected" in trained.out) == (persons == 1)
    said = nao_sim("recognize", sample_clips / "yes.avi", "--database", tmp_path / "own.parquet", "--json")
    assert said.code == 0
    assert json.loads(said.out)["nearest"] == "yes"
