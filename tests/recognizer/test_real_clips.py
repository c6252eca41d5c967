"""What the shipped database says of real people, who took no part in it; skipped where the recordings are not."""

from __future__ import annotations

from pathlib import Path

import pytest

from nao_sim.resources import resource
from recognizer import Recognizer, open_clip

FELIX = {(6, 44): "bye_right", (48, 86): "bye_two_hands", (114, 124): "bye_two_hands"}


@pytest.fixture(scope="module")
def shipped() -> Recognizer:
    return Recognizer.load(resource("assets", "databases", "dynamic.parquet"))


def test_real_waves_are_named_or_rejected_but_never_taken_for_something_else(
    shipped: Recognizer, real_clips: Path
) -> None:
    clips = [(open_clip(path), "bye_right") for path in sorted(real_clips.glob("dynamic/PS7A2*.avi"))]
    clips += [(open_clip(real_clips / "dynamic" / "felix_wave.mp4", part), wave) for part, wave in FELIX.items()]
    said = [(shipped.recognize(clip).label, wave) for clip, wave in clips]
    assert all(label in (None, wave) for label, wave in said)
    assert sum(label == wave for label, wave in said) >= 4


def test_other_motions_of_real_people_are_rejected(shipped: Recognizer, real_clips: Path) -> None:
    paths = [*real_clips.glob("dynamic/PS7A[13]*.avi"), *real_clips.glob("negative/*.m*")]
    rejected = [shipped.recognize(path).rejected for path in paths]
    assert len(rejected) == 18
    assert sum(rejected) >= 17
