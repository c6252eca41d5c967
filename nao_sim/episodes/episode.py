"""An episode: what was seen, what was answered, what the body did, how well, and what made it."""

from __future__ import annotations

from dataclasses import asdict, dataclass
from typing import TYPE_CHECKING, Any

from nao_sim.episodes.outcome import Outcome

if TYPE_CHECKING:
    from nao_sim.motion import MotionLog
    from recognizer import Clip, Recognition

SCHEMA = 1
"""Version of ``episode.json``; rises when a key changes its meaning."""


@dataclass(frozen=True)
class Answer:
    """What the robot decided to do.

    Attributes:
        gesture: the gesture of the library that was played; None: it stood still.
        mirrored: whether left and right were exchanged, as in a mirror.
        reason: why it stood still; empty otherwise.
    """

    gesture: str | None
    mirrored: bool
    reason: str = ""


@dataclass(frozen=True)
class Episode:
    """One clip seen and one motion made.

    Attributes:
        clip: the clip that was watched.
        recognition: what the recogniser said, with its evidence.
        answer: what the robot decided to do.
        motion: what the body did; time starts at 0 when the motion starts.
        outcome: how well it did it.
        timings_s: wall-clock seconds of each stage of the work.
        provenance: versions and hashes of what made the episode.
    """

    clip: Clip
    recognition: Recognition
    answer: Answer
    motion: MotionLog
    outcome: Outcome
    timings_s: dict[str, float]
    provenance: dict[str, Any]

    @property
    def frame_count(self) -> int:
        """How many frames of the clip were watched."""
        return self.recognition.watched.frames

    @property
    def watched_s(self) -> float:
        """Length of the watched part of the clip, seconds."""
        return self.recognition.watched.seconds

    def to_dict(self) -> dict[str, Any]:
        """Everything but the arrays, as ``episode.json`` keeps it."""
        first = self.clip.frames[0]
        return {
            "schema": SCHEMA,
            "clip": {
                "file": self.clip.source,
                "frames": [first, first + self.frame_count - 1],
                "fps": self.clip.fps,
                "size": list(self.clip.size),
            },
            "seen": self.recognition.to_dict(),
            "answered": asdict(self.answer),
            "done": asdict(self.outcome),
            "timings_s": self.timings_s,
            "provenance": self.provenance,
        }
