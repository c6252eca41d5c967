"""The episode in words: the decision, and which phase it is in."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nao_sim.recording.moments import moment

if TYPE_CHECKING:
    import rerun as rr

PHASES = {
    "watch": ("Watching the person", 0x4F86C6FF),
    "imitate": ("Robot imitates", 0x4CAF50FF),
    "stand": ("Robot stands still", 0xB0A080FF),
    "fallen": ("Robot has fallen", 0xE53935FF),
    "end": ("Done", 0x808080FF),
}


def log_phases(stream: rr.RecordingStream, phases: Sequence[tuple[float, str]]) -> None:
    """Log the phases of the episode as a state timeline.

    Args:
        stream: an open recording.
        phases: start in seconds and the phase's key in ``PHASES``.
    """
    import rerun as rr

    labels, colours = zip(*PHASES.values(), strict=True)
    stream.log("phase", rr.StateConfiguration(values=list(PHASES), labels=labels, colors=colours), static=True)
    for start, phase in phases:
        with moment(stream, start):
            stream.log("phase", rr.StateChange(state=phase))


def log_decision(stream: rr.RecordingStream, before: str, decided_at: float, decision: str) -> None:
    """Log the text panel: what is known before the decision, and the decision itself (both Markdown)."""
    for t, text in ((0.0, before), (decided_at, decision)):
        log_text(stream, t, text)


def log_text(stream: rr.RecordingStream, t: float, text: str) -> None:
    """Log what the text panel says from a moment [s] on, Markdown."""
    import rerun as rr

    with moment(stream, t):
        stream.log("decision", rr.TextDocument(text, media_type=rr.MediaType.MARKDOWN))
