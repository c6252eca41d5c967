"""What the shipped database says of real people, who took no part in it; skipped where the recordings are not."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from recognizer import Recognizer, open_clip

SIGNS = ["again", "bird", "brother", "help", "milk", "no", "please", "sorry", "student", "thanks", "yes"]
FELIX = {(6, 44): "bye_right", (48, 86): "bye_two_hands", (114, 124): "bye_two_hands"}


def test_real_waves_are_named_or_rejected_but_never_taken_for_something_else(
    shipped: Recognizer, recorded: Callable[[str], Path]
) -> None:
    clips = [(open_clip(recorded(f"dynamic/PS7A2P1T{take}.avi")), "bye_right") for take in (1, 2, 3)]
    clips += [(open_clip(recorded("dynamic/felix_wave.mp4"), part), wave) for part, wave in FELIX.items()]
    said = [(shipped.recognize(clip).label, wave) for clip, wave in clips]
    assert all(label in (None, wave) for label, wave in said)
    assert sum(label == wave for label, wave in said) >= 4


def test_other_motions_of_real_people_are_rejected(shipped: Recognizer, recorded: Callable[[str], Path]) -> None:
    paths = [recorded(f"dynamic/PS7A{raised}P1T{take}.avi") for raised in (1, 3) for take in (1, 2, 3)]
    paths += [recorded("negative/felix_stand.mp4"), *(recorded(f"negative/asl_{sign}.mkv") for sign in SIGNS)]
    rejected = [shipped.recognize(path).rejected for path in paths]
    assert len(rejected) == 18
    assert sum(rejected) >= 17
