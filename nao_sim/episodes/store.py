"""An episode on disk: one folder with ``episode.json``, ``episode.parquet`` and ``episode.rrd``."""

from __future__ import annotations

import json
from collections.abc import Callable
from pathlib import Path

from nao_sim.episodes.episode import Episode
from nao_sim.episodes.folder import complete_folder
from nao_sim.episodes.record import record_episode
from nao_sim.episodes.table import write_table
from nao_sim.robot import ACTUATED, Nao

SUMMARY, TABLE, RECORDING = "episode.json", "episode.parquet", "episode.rrd"


def save_episode(folder: Path, episode: Episode, nao: Nao, progress: Callable[[int], None] | None = None) -> None:
    """Write an episode; the folder appears when it is complete, and replaces an older episode there.

    Args:
        folder: where it shall stand.
        episode: what happened.
        nao: the robot that performed it.
        progress: called with the number of video frames stored so far.

    Raises:
        EpisodeError: the place cannot be written, or holds something that is not an episode.
        RecordingError: the recording cannot be written.
    """
    with complete_folder(folder, SUMMARY) as work:
        record_episode(work / RECORDING, episode, nao, progress)
        gesture = episode.answer.gesture or ""
        write_table(work / TABLE, episode.motion, ACTUATED, {"gesture": gesture, "clip": episode.clip.source})
        text = json.dumps(episode.to_dict(), indent=2, ensure_ascii=False, allow_nan=False)
        (work / SUMMARY).write_text(text + "\n", encoding="utf-8")
