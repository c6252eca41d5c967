"""From a sample clip to a folder on disk, read back."""

from __future__ import annotations

import dataclasses
import json
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from rerun.chunk import RrdReader

from nao_sim.episodes import Episode, imitate, save_episode
from nao_sim.episodes.imitate import answer_to, gesture_of, move
from nao_sim.episodes.outcome import measure, moving_joints, torso_tilt_rad
from nao_sim.robot import ACTUATED, Nao, joint_table


@pytest.fixture(scope="module")
def wave(sample_clips: Path) -> tuple[Episode, Nao]:
    return imitate(sample_clips / "bye_right.avi")


@pytest.fixture(scope="module")
def folder(wave: tuple[Episode, Nao], tmp_path_factory: pytest.TempPathFactory) -> Path:
    out = tmp_path_factory.mktemp("episodes") / "wave"
    save_episode(out, *wave)
    return out


def test_a_wave_is_answered_with_a_wave(wave: tuple[Episode, Nao]) -> None:
    episode, _ = wave
    assert episode.recognition.label == "bye_right"
    assert episode.answer.gesture == "bye_right"
    assert not episode.outcome.fell
    assert episode.outcome.torso_tilt_end_deg < 8
    assert episode.outcome.tracking_rms_deg < 2
    moving = moving_joints(episode.motion.targets, ACTUATED)
    assert {"RShoulderPitch", "RElbowRoll"} <= set(moving)
    assert not {"LElbowRoll", "LShoulderRoll"} & set(moving)


def test_targets_stay_inside_the_ranges(wave: tuple[Episode, Nao]) -> None:
    episode, nao = wave
    low, high = joint_table().select(ACTUATED).range_rad(nao.limits).T
    assert (episode.motion.targets >= low).all()
    assert (episode.motion.targets <= high).all()


def test_a_mirror_answers_with_the_other_hand(wave: tuple[Episode, Nao]) -> None:
    recognition = wave[0].recognition
    assert answer_to(recognition).gesture == "bye_right"
    assert answer_to(recognition, mirror=True).gesture == "bye_left"


@pytest.mark.parametrize("label", ["stop", "pointing"])  # pointing is its own twin, stop is not
def test_a_mirror_answers_with_the_left_hand(wave: tuple[Episode, Nao], label: str) -> None:
    seen = dataclasses.replace(wave[0].recognition, label=label)
    for mirror, moving, still in ((False, "RElbowRoll", "LElbowRoll"), (True, "LElbowRoll", "RElbowRoll")):
        gesture = gesture_of(answer_to(seen, mirror))
        assert gesture is not None
        assert moving in gesture.joints
        assert still not in gesture.joints


def test_what_is_rejected_does_not_move_the_robot(wave: tuple[Episode, Nao]) -> None:
    rejected = dataclasses.replace(wave[0].recognition, label=None, rejected=True, reason="too far from everything")
    answer = answer_to(rejected)
    assert answer.gesture is None
    assert answer.reason == "too far from everything"
    still = move(Nao(), None)
    assert np.ptp(still.targets, axis=0).max() == 0
    assert np.ptp(still.angles, axis=0).max() < np.radians(0.5)


def test_only_the_frames_asked_for_are_watched(sample_clips: Path) -> None:
    episode, _ = imitate(sample_clips / "bye_right.avi", frames=(2, 21))
    assert episode.frame_count == 20
    assert episode.to_dict()["clip"]["frames"] == [2, 21]


def test_the_summary_says_what_happened_and_what_made_it(wave: tuple[Episode, Nao], folder: Path) -> None:
    summary = json.loads((folder / "episode.json").read_text())
    assert set(summary) == {"schema", "clip", "seen", "answered", "done", "timings_s", "provenance"}
    assert summary["seen"]["label"] == "bye_right"
    assert len(summary["provenance"]["clip_sha256"]) == 64
    assert summary["provenance"]["versions"]["mujoco"].startswith("3.")
    assert summary["done"]["fell"] is False


def test_the_table_holds_the_motion(wave: tuple[Episode, Nao], folder: Path) -> None:
    motion = wave[0].motion
    table = pq.read_table(folder / "episode.parquet")
    np.testing.assert_allclose(np.diff(table["time"].to_numpy()), 0.02, atol=1e-9)
    for j, name in enumerate(ACTUATED):
        np.testing.assert_array_equal(table[f"{name}.target"].to_numpy(), motion.targets[:, j])
        np.testing.assert_array_equal(table[f"{name}.torque"].to_numpy(), motion.torques[:, j])
    assert table.schema.field("RElbowRoll.angle").metadata[b"unit"] == b"rad"
    assert table.schema.field("LHand.angle").metadata[b"unit"] == b"1"
    np.testing.assert_array_equal(table["torso.z"].to_numpy(), motion.torso_pose[:, 2])
    assert table["RFsrRR"].to_numpy().min() >= 0


def test_the_recording_holds_clip_and_motion_one_after_the_other(wave: tuple[Episode, Nao], folder: Path) -> None:
    episode, _ = wave
    ends: dict[str, float] = {}
    for chunk in RrdReader(folder / "episode.rrd").stream():
        if not chunk.is_static:
            times = chunk.to_record_batch()["time"].cast("int64").to_numpy() * 1e-9
            ends[chunk.entity_path] = max(ends.get(chunk.entity_path, 0.0), float(times.max()))
    assert ends["/video/frame"] == pytest.approx(episode.watched_s - 1 / episode.clip.fps)
    assert ends["/joints/RElbowRoll/angle"] == pytest.approx(episode.watched_s + episode.motion.time[-1])
    assert ends["/evidence/difference/picture"] == pytest.approx(episode.watched_s)
    assert {"/phase", "/decision", "/video/flow", "/video/centroid", "/world/robot/head"} <= set(ends)


def test_the_same_clip_gives_the_same_episode(wave: tuple[Episode, Nao], sample_clips: Path) -> None:
    first, (second, _) = wave[0], imitate(sample_clips / "bye_right.avi")
    np.testing.assert_array_equal(first.motion.angles, second.motion.angles)
    np.testing.assert_array_equal(first.motion.torso_pose, second.motion.torso_pose)
    assert first.recognition.distance == second.recognition.distance


def test_tilt_is_the_angle_from_the_vertical() -> None:
    angle = np.radians(30.0)
    about_y = [0, 0, 0.3, np.cos(angle / 2), 0, np.sin(angle / 2), 0]
    about_z = [0, 0, 0.3, np.cos(angle / 2), 0, 0, np.sin(angle / 2)]
    np.testing.assert_allclose(torso_tilt_rad(np.array([about_y, about_z])), [angle, 0], atol=1e-7)


def test_a_fall_is_told(wave: tuple[Episode, Nao]) -> None:
    fallen = dataclasses.replace(wave[0].motion, fallen=True, fell_at=1.5)
    outcome = measure(fallen, ACTUATED)
    assert outcome.fell
    assert outcome.fell_at_s == 1.5
