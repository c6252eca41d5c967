"""The main job: a clip in, the robot's imitation out."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from nao_sim.episodes.episode import Answer, Episode
from nao_sim.episodes.errors import EpisodeError
from nao_sim.episodes.outcome import measure
from nao_sim.episodes.provenance import sha256, software, tree_sha256
from nao_sim.episodes.see import database_of, see
from nao_sim.gestures import library, mirrored
from nao_sim.gestures.act import act
from nao_sim.motion import MotionLog, Trajectory, perform
from nao_sim.resources import resource
from nao_sim.robot import ACTUATED, Nao
from recognizer import Clip, Recognition, open_clip

if TYPE_CHECKING:
    from nao_sim.gestures import Gesture

STANDING_S = 1.0
"""How long an episode shows the robot standing when it does not answer."""

SETTLE_S = 0.5
"""The robot stands this long before it moves, so that its weight is on its feet."""

Progress = Callable[[str, int, int | None], None]


@dataclass(frozen=True)
class Timer:
    """Wall-clock seconds by stage."""

    seconds: dict[str, float]

    def measure(self, stage: str, begun: float) -> None:
        """Write down how long a stage took that began at ``begun`` (``time.perf_counter``)."""
        self.seconds[stage] = round(time.perf_counter() - begun, 4)


def answer_to(recognition: Recognition, mirror: bool = False) -> Answer:
    """Decide what the robot does about what it has seen.

    A rejected or irrelevant motion must not trigger the robot (thesis, appendix 2).

    Args:
        recognition: what the person did.
        mirror: exchange left and right, as a mirror would; otherwise right answers right.
    """
    if recognition.rejected or recognition.label is None:
        return Answer(None, False, recognition.reason or "no known gesture")
    return answer_to_label(recognition.label, mirror)


def answer_to_label(label: str, mirror: bool = False) -> Answer:
    """Decide what the robot does about a known gesture; ``mirror`` as in :func:`answer_to`."""
    gestures = library()
    name = gestures[label].mirror if mirror and label in gestures else label
    if name not in gestures:
        return Answer(None, mirror, f"the gesture library has no '{name}'")
    return Answer(name, mirror)


def gesture_of(answer: Answer) -> Gesture | None:
    """Return what the robot plays for an answer; a gesture that is its own twin, as *pointing*, changes the hand."""
    if answer.gesture is None:
        return None
    gesture = library()[answer.gesture]
    own_twin = gesture.mirror == gesture.name
    return mirrored(gesture) if answer.mirrored and own_twin else gesture


def move(nao: Nao, gesture: Gesture | None) -> MotionLog:
    """Perform a gesture from standing, or stand still for ``STANDING_S`` seconds."""
    nao.reset("StandInit")
    nao.step(round(SETTLE_S / nao.control_period))
    if gesture is None:
        still = Trajectory(np.zeros(1), nao.setpoint[None])
        return perform(nao, still, settle_s=STANDING_S)
    return act(nao, gesture).log


def imitate(
    video: str | Path,
    *,
    frames: tuple[int, int | None] | None = None,
    mirror: bool = False,
    among: Iterable[str] | None = None,
    database: Path | None = None,
    nao: Nao | None = None,
    progress: Progress | None = None,
) -> tuple[Episode, Nao]:
    """Watch a clip or photo and let the simulated NAO answer it.

    Args:
        video: the file.
        frames: first and last frame to watch, both included.
        mirror: answer as a mirror would.
        among: labels that the context allows; None for all.
        database: the recogniser's database; None for the one that comes with the package.
        nao: the robot; None for a new one of the thesis's limits. It is reset.
        progress: called with a stage, how much of it is done, and how much there is (None: not known).

    Returns:
        The episode, and the robot that performed it.

    Raises:
        RecognizerError: the clip or the database cannot be used.
        NaoSimError: the robot cannot perform the gesture.
    """
    timer = Timer({})
    clip = open_clip(video, frames)
    database = database or database_of(clip)
    recognition = _see(clip, database, among, timer, progress)
    answer = answer_to(recognition, mirror)
    nao = nao or Nao()
    begun = time.perf_counter()
    motion = move(nao, gesture_of(answer))
    timer.measure("move", begun)
    provenance = {
        "clip_sha256": sha256(Path(video)),
        "database_sha256": sha256(database),
        "model_sha256": tree_sha256(resource("models", "nao")),
        "gestures_sha256": tree_sha256(resource("assets", "gestures")),
        **software(),
    }
    outcome = measure(motion, ACTUATED)
    return Episode(clip, recognition, answer, motion, outcome, timer.seconds, provenance), nao


def _see(
    clip: Clip, database: Path, among: Iterable[str] | None, timer: Timer, progress: Progress | None
) -> Recognition:
    def count(done: int, total: int | None) -> None:
        if progress is not None:
            progress("Watching", done, total)

    begun = time.perf_counter()
    try:
        recognition = see(clip, database, among, count)
    except MemoryError:
        raise EpisodeError(f"{clip.source} does not fit in memory; choose a part of it with --frames") from None
    timer.measure("see", begun)
    return recognition
