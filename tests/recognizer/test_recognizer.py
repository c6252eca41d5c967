"""The shipped recogniser on the shipped sample clips, and on them changed."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

from nao_sim.gestures.vocabulary import vocabulary
from recognizer import Clip, ClipError, Recognizer, open_clip
from recognizer.explain import explain
from recognizer.tracking import track_clip

SAMPLES = [name for name, entry in vocabulary().items() if entry.family in ("small", "large")]
ROBUST = ("bye_right", "bye_two_hands", "kowtow", "right_arm_up", "left_arm_pointing_left", "walk_left_to_right")


@pytest.fixture(scope="module")
def recognizer(shipped: Recognizer) -> Recognizer:
    return shipped


def frames_of(folder: Path, name: str) -> tuple[np.ndarray, float]:
    clip = open_clip(folder / f"{name}.avi")
    return np.array(list(clip)), clip.fps


@pytest.mark.parametrize("name", SAMPLES)
def test_sample_clips_are_named(recognizer: Recognizer, sample_clips: Path, name: str) -> None:
    answer = recognizer.recognize(sample_clips / f"{name}.avi")
    assert answer.label == name
    assert answer.family == vocabulary()[name].family
    assert answer.distance <= answer.threshold
    assert sum(answer.votes.values()) == pytest.approx(1)


@pytest.mark.parametrize("name", ROBUST)
def test_mirroring_a_clip_mirrors_the_answer(recognizer: Recognizer, sample_clips: Path, name: str) -> None:
    frames, fps = frames_of(sample_clips, name)
    answer = recognizer.recognize(Clip.from_array(np.ascontiguousarray(frames[:, :, ::-1]), fps))
    twin = vocabulary()[name].mirror
    if twin in SAMPLES:
        assert answer.nearest == twin
    else:
        assert answer.label != name  # left_arm_up is no class of ours


def shifted(frames: np.ndarray) -> np.ndarray:
    matrix = np.array([[1, 0, 0.05 * frames.shape[2]], [0, 1, 0.03 * frames.shape[1]]], np.float32)
    size = (frames.shape[2], frames.shape[1])
    return np.array([cv2.warpAffine(f, matrix, size, borderMode=cv2.BORDER_REPLICATE) for f in frames])


def smaller(frames: np.ndarray) -> np.ndarray:
    size = (round(frames.shape[2] * 0.75), round(frames.shape[1] * 0.75))
    return np.array([cv2.resize(f, size, interpolation=cv2.INTER_AREA) for f in frames])


def brighter(frames: np.ndarray) -> np.ndarray:
    return (frames * 1.15 + 12).clip(0, 255).astype(np.uint8)


@pytest.mark.parametrize("change", [shifted, smaller, brighter])
@pytest.mark.parametrize("name", ROBUST)
def test_small_changes_do_not_change_the_answer(
    recognizer: Recognizer, sample_clips: Path, name: str, change: object
) -> None:
    frames, fps = frames_of(sample_clips, name)
    assert recognizer.recognize(Clip.from_array(change(frames), fps)).nearest == name  # type: ignore[operator]


def at_double_rate(frames: np.ndarray) -> np.ndarray:
    """The same clip as a camera twice as fast might have seen it: blends between neighbouring frames."""
    between = ((frames[:-1].astype(np.uint16) + frames[1:]) // 2).astype(np.uint8)
    out = np.repeat(frames, 2, axis=0)[:-1]
    out[1::2] = between
    return out


@pytest.mark.parametrize("name", ROBUST)
def test_half_or_double_the_frame_rate_does_not_change_the_answer(
    recognizer: Recognizer, sample_clips: Path, name: str
) -> None:
    frames, fps = frames_of(sample_clips, name)
    changed = Clip.from_array(frames[::2], fps / 2) if fps >= 20 else Clip.from_array(at_double_rate(frames), 2 * fps)
    assert recognizer.recognize(changed).nearest == name


def test_streamed_and_read_give_the_same_answer(recognizer: Recognizer, sample_clips: Path) -> None:
    path = sample_clips / "bye_right.avi"
    clip = open_clip(path)
    stream = recognizer.stream(clip.fps)
    for frame in clip:
        stream.push(frame)
    a, b = stream.finish(), recognizer.recognize(path)
    assert (a.label, a.distance, a.neighbours) == (b.label, b.distance, b.neighbours)


def test_evidence_can_be_drawn(recognizer: Recognizer, sample_clips: Path, tmp_path: Path) -> None:
    answer = recognizer.recognize(sample_clips / "bye_right.avi")
    evidence = answer.evidence
    assert evidence is not None
    assert len(evidence.key_frames) == 8
    assert len(evidence.difference_images) == len(evidence.ellipses) == 6
    assert len(evidence.boxes) == len(evidence.samples) == len(evidence.centroid_path)
    paths = explain(answer, tmp_path)
    assert len(paths) == 7
    assert all(cv2.imread(str(path)) is not None for path in paths)


def test_memory_does_not_grow(sample_clips: Path) -> None:
    frames, _ = frames_of(sample_clips, "yes")
    track = track_clip(Clip.from_array(np.concatenate([frames] * 8)[:300], 10.0))
    assert len(track.samples) == len(track.steps) == len(track.regions) + 1 == 120


def test_answer_goes_to_plain_values(recognizer: Recognizer, sample_clips: Path) -> None:
    import json

    plain = recognizer.recognize(sample_clips / "yes.avi").to_dict()
    assert json.loads(json.dumps(plain, allow_nan=False))["nearest"] == plain["nearest"]


def test_no_motion_a_cut_and_a_moving_camera_are_said(recognizer: Recognizer, sample_clips: Path) -> None:
    rng = np.random.default_rng(0)
    wall = cv2.GaussianBlur(rng.integers(0, 255, (160, 260, 3), np.uint8), (0, 0), 3)
    wall = cv2.normalize(wall, None, 0, 255, cv2.NORM_MINMAX)
    for seed in range(4):  # whatever stands there
        view = np.random.default_rng(seed).permutation(wall)[:120, :160]
        still = recognizer.recognize(Clip.from_array([view] * 20, 10))
        assert still.rejected
        assert still.label is None
        assert "nothing moves" in still.reason
        assert any("nothing moves" in w for w in still.warnings)
    panned = recognizer.recognize(Clip.from_array([wall[:120, 2 * i : 2 * i + 160] for i in range(40)], 10))
    assert any("camera" in w for w in panned.warnings)
    frames, fps = frames_of(sample_clips, "yes")
    cut = recognizer.recognize(Clip.from_array(np.concatenate([frames[:30], 255 - frames[:30]]), fps))
    assert any("cut" in w for w in cut.warnings)


def test_too_short_and_photos_are_refused(recognizer: Recognizer, sample_clips: Path) -> None:
    frames, fps = frames_of(sample_clips, "yes")
    with pytest.raises(ClipError, match="5 frames, too short"):
        recognizer.recognize(Clip.from_array(frames[:5], fps))
    with pytest.raises(ClipError, match="photo"):
        recognizer.recognize(Clip.from_array(frames[:1], fps))
    stream = recognizer.stream(10)
    stream.push(frames[0])
    with pytest.raises(ClipError, match="frame size"):
        stream.push(frames[1][:-10])


def test_one_colour_channel_is_enough(recognizer: Recognizer, sample_clips: Path) -> None:
    frames, fps = frames_of(sample_clips, "bye_right")
    grey = np.array([cv2.cvtColor(f, cv2.COLOR_BGR2GRAY) for f in frames])
    assert recognizer.recognize(Clip.from_array(grey, fps)).nearest == "bye_right"


def test_two_turns_in_one_video_are_answered_apart(recognizer: Recognizer, sample_clips: Path) -> None:
    frames, fps = frames_of(sample_clips, "bye_right")
    rest = np.repeat(frames[-1:], round(1.5 * fps), axis=0)
    answers = recognizer.recognize_all(Clip.from_array(np.concatenate([rest, frames, rest, frames, rest]), fps))
    assert [a.nearest for a in answers] == ["bye_right"] * 2
    assert answers[0].end <= answers[1].start + 0.8
    assert recognizer.recognize_all(Clip.from_array(rest, fps)) == []


def test_shots_cut_together_are_answered_apart(recognizer: Recognizer, sample_clips: Path) -> None:
    names, shots = ("bye_right", "yes", "right_arm_up"), []
    for name in names:
        frames, fps = frames_of(sample_clips, name)
        at_25 = np.arange(0, len(frames) - 1, fps / 25).round().astype(int)
        shots.append(np.array([cv2.resize(frame, (320, 240)) for frame in frames[at_25]]))
    answers = recognizer.recognize_all(Clip.from_array(np.concatenate(shots), 25.0))
    assert [answer.label for answer in answers] == list(names)
    cuts = np.cumsum([len(shot) / 25 for shot in shots])
    assert all(a.end <= cut <= b.start + 0.1 for a, b, cut in zip(answers, answers[1:], cuts, strict=False))
    assert not any(answer.warnings for answer in answers)
