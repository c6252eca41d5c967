"""The pieces of a session's recording: one file a turn, all of one recording, so that the viewer joins them."""

from __future__ import annotations

import hashlib
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nao_sim.episodes.record import decision_text
from nao_sim.game.store.lanes import log_lanes, log_states
from nao_sim.game.store.layout import session_layout
from nao_sim.game.store.turn_record import Done, Shown, TurnRecord
from nao_sim.game.tables import Turn
from nao_sim.recording.joints import log_balance, log_joints
from nao_sim.recording.narrative import log_text
from nao_sim.recording.robot import log_body_poses, log_shells
from nao_sim.recording.stream import recording
from nao_sim.recording.video import log_boxes, log_no_picture, log_pictures
from nao_sim.robot import ACTUATED, joint_table

if TYPE_CHECKING:
    import rerun as rr

    from nao_sim.motion import MotionLog
    from nao_sim.robot import Nao


def recording_id(session: str, started: str) -> str:
    """Return the identity that all pieces of one session's recording share."""
    return hashlib.sha256(f"{session} {started}".encode()).hexdigest()[:32]


def record_start(path: Path, name: str, identity: str, nao: Nao | None) -> None:
    """Write what stands still in a session: the robot's body and the lanes' names."""
    with recording(path, name, identity, session_layout(nao is not None)) as stream:
        log_lanes(stream)
        if nao is not None:
            log_shells(stream, nao.model)


def record_piece(path: Path, name: str, identity: str, nao: Nao | None, piece: TurnRecord, turn: Turn | None) -> None:
    """Write what happened in a turn or phase.

    Args:
        path: the ``.rrd`` file.
        name: of the session.
        identity: see :func:`recording_id`.
        nao: the robot; None: none takes part.
        piece: what happened.
        turn: its row; None: a phase.
    """
    with recording(path, name, identity, session_layout(nao is not None)) as stream:
        log_states(stream, sorted(piece.states, key=lambda state: state[1]))
        log_no_picture(stream, piece.begun_s)
        for shown in piece.films:
            _log_film(stream, shown)
        for done in piece.motions:
            if nao is not None:
                _log_motion(stream, nao, done)
        for at, text in piece.notes:
            log_text(stream, at, text)
        if turn is not None:
            _log_words(stream, piece, turn)


def _log_film(stream: rr.RecordingStream, shown: Shown) -> None:
    watched = shown.watched
    if watched.pictures:
        log_pictures(stream, shown.start_s + np.array(watched.times), watched.pictures)
    evidence = None if watched.recognition is None else watched.recognition.evidence
    if evidence is not None:
        moments = shown.start_s + np.array([sample.time for sample in evidence.samples])
        log_boxes(stream, moments, [boxes * np.tile(np.array(watched.size, float), 2) for boxes in evidence.boxes])


def _log_motion(stream: rr.RecordingStream, nao: Nao, done: Done) -> None:
    log: MotionLog = done.log
    time = done.start_s + log.time
    joint_range = joint_table().select(ACTUATED).range_rad(nao.limits)
    log_body_poses(stream, nao.model, time, log.body_pose)
    log_joints(stream, ACTUATED, joint_range, time, log.targets, log.angles, log.torques)
    log_balance(stream, time, log.torso_pose, log.contacts)


def _log_words(stream: rr.RecordingStream, piece: TurnRecord, turn: Turn) -> None:
    """The turn in words: before it is over, what is asked; then what was seen, why, and how it is scored."""
    head = f"# Turn {turn.turn}: {turn.model} → {turn.imitator}\n\nasked: **{turn.target}** ({turn.phase})"
    log_text(stream, piece.begun_s, head)
    if not piece.films:
        return
    last = piece.films[-1]
    lines = [head]
    if turn.excluded is not None:
        lines.append(f"**no trial: {turn.excluded.replace('_', ' ')}** {turn.excluded_note}")
    elif turn.auto_score is not None:
        side = f", {turn.side} side" if turn.side else ""
        lines.append(f"proposed score **{turn.auto_score}** of {turn.auto_scale}{side}; help: {turn.prompt_level}")
    if turn.latency_s is not None:
        lines.append(f"moved {turn.latency_s:.1f} s after the model's end")
    elif turn.latency_censored and turn.waited_s is not None:
        lines.append(f"nobody moved within {turn.waited_s:.1f} s")
    if turn.note:
        lines.append(turn.note)
    if last.watched.recognition is not None:
        lines.append(decision_text(last.watched.recognition, "").replace("# ", "## seen: ", 1))
    log_text(stream, last.end_s, "\n\n".join(lines))
