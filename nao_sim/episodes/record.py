"""An episode as a Rerun recording: the clip first, then the robot's answer, on one time line."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nao_sim.episodes.outcome import moving_joints
from nao_sim.recording.joints import log_balance, log_joints
from nao_sim.recording.layout import layout
from nao_sim.recording.narrative import log_decision, log_phases
from nao_sim.recording.properties import send_properties
from nao_sim.recording.robot import log_body_poses, log_shells
from nao_sim.recording.stream import recording
from nao_sim.recording.video import (
    log_boxes,
    log_centroid_path,
    log_ellipses,
    log_frames,
    log_picture,
    stored_scale,
)
from nao_sim.robot import ACTUATED, joint_table

if TYPE_CHECKING:
    import rerun as rr

    from nao_sim.episodes.episode import Episode
    from nao_sim.robot import Nao
    from recognizer import Recognition

_SHOWN_JOINTS = 6


def decision_text(recognition: Recognition, reason: str) -> str:
    """The decision as Markdown: the answer, why, and the nearest neighbours."""
    if recognition.rejected:
        nearest = f" (nearest: {recognition.nearest})" if recognition.nearest else ""
        head = f"# None of these{nearest}\n\n{recognition.reason}"
    else:
        head = f"# {recognition.label}\n\n{recognition.family} amplitude"
    distance = ""
    if recognition.nearest:
        distance = f"distance **{recognition.distance:.3f}**, rejected beyond {recognition.threshold:.3f}"
    rows = [f"| {n.label} | {n.person} | {n.distance:.3f} |" for n in recognition.neighbours]
    table = "\n".join(["| neighbour | person | distance |", "|---|---|---|", *rows])
    notes = "\n".join(f"- {warning}" for warning in recognition.warnings)
    still = f"The robot stands still: {reason}" if reason else ""
    return "\n\n".join(part for part in (head, distance, still, notes, table) if part)


def _log_evidence(stream: rr.RecordingStream, episode: Episode) -> None:
    """Flow boxes, centroid path, key frames, difference image and ellipses of a moving clip."""
    evidence = episode.recognition.evidence
    if evidence is None:
        return
    size = np.array(episode.clip.size, float)
    stored = size * stored_scale(*episode.clip.size)
    time = np.array([sample.time for sample in evidence.samples])
    log_boxes(stream, time, [boxes * np.tile(stored, 2) for boxes in evidence.boxes])
    path = evidence.centroid_path
    seen = np.isfinite(path).all(axis=1)
    log_centroid_path(stream, time[seen], path[seen] * stored)
    first, second = evidence.key_samples[:2]
    ellipses = evidence.ellipses[0]
    pictures = {"first_key_frame": first.image, "second_key_frame": second.image}
    pictures["difference"] = evidence.difference_images[0]
    for name, image in pictures.items():
        log_picture(stream, f"evidence/{name}", episode.watched_s, image)
        height, width = image.shape[:2]
        if ellipses:
            centres = np.array([[e.x * width, e.y * height] for e in ellipses])
            halves = np.array([[e.sx * width, e.sy * height] for e in ellipses])
            log_ellipses(stream, f"evidence/{name}", episode.watched_s, centres, halves)


def _properties(episode: Episode) -> dict[str, object]:
    """What a catalog of many episodes lists and sorts by."""
    seen, done = episode.recognition, episode.outcome
    return {
        "clip": Path(episode.clip.source).name,
        "seen": seen.label or "",
        "distance": seen.distance,
        "answered": episode.answer.gesture or "",
        "upright": "no" if done.fell else "yes",
        "tracking_rms_deg": done.tracking_rms_deg,
        "duration_s": done.duration_s,
    }


def _phases(episode: Episode) -> list[tuple[float, str]]:
    start = episode.watched_s
    phases = [(0.0, "watch"), (start, "imitate" if episode.answer.gesture else "stand")]
    if episode.outcome.fell_at_s is not None:
        phases.append((start + episode.outcome.fell_at_s, "fallen"))
    phases.append((start + episode.outcome.duration_s, "end"))
    return phases


def record_episode(path: Path, episode: Episode, nao: Nao, progress: Callable[[int], None] | None = None) -> None:
    """Write an episode's recording.

    Args:
        path: the ``.rrd`` file.
        episode: what happened.
        nao: the robot that performed it.
        progress: called with the number of frames stored so far.

    Raises:
        RecordingError: the file cannot be written.
    """
    motion = episode.motion
    moving = moving_joints(motion.targets, ACTUATED)[:_SHOWN_JOINTS]
    name = f"{Path(episode.clip.source).name}: {episode.answer.gesture or 'no gesture'}"
    identity = f"{episode.provenance['clip_sha256'][:16]}-{episode.clip.frames[0]}-{episode.answer.gesture}"
    # The robot stands through the clip, so its first state is shown from the beginning.
    time = np.concatenate([[0.0], episode.watched_s + motion.time])
    still_first = np.concatenate([[0], np.arange(len(motion.time))])
    with recording(path, name, identity, layout(ACTUATED, moving)) as stream:
        send_properties(stream, "episode", _properties(episode))
        log_shells(stream, nao.model)
        log_phases(stream, _phases(episode))
        text = decision_text(episode.recognition, episode.answer.reason)
        log_decision(stream, "# Watching …", episode.watched_s, text)
        log_frames(stream, episode.clip.timed(), progress)
        _log_evidence(stream, episode)
        log_body_poses(stream, nao.model, time, motion.body_pose[still_first])
        joint_range = joint_table().select(ACTUATED).range_rad(nao.limits)
        log_joints(
            stream,
            ACTUATED,
            joint_range,
            time,
            motion.targets[still_first],
            motion.angles[still_first],
            motion.torques[still_first],
        )
        log_balance(stream, time, motion.torso_pose[still_first], motion.contacts[still_first])
