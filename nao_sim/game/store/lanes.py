"""The session's story as lanes of states: phase, turn, who does what, help given, score."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from nao_sim.recording.moments import moment

if TYPE_CHECKING:
    import rerun as rr

STORY = "story"

NOTHING = 0x00000000
_GREEN, _AMBER, _RED, _BLUE, _VIOLET, _SAND = 0x4CAF50FF, 0xFFB300FF, 0xE53935FF, 0x4F86C6FF, 0x8E6BBFFF, 0xB0A080FF

LANES: dict[str, dict[str, tuple[str, int]]] = {
    "1_phase": {
        "orientation": ("Orientation", _SAND),
        "baseline": ("Baseline, no feedback", _VIOLET),
        "game": ("Game", _BLUE),
        "closing": ("Closing", _SAND),
        "end": (" ", NOTHING),
    },
    "3_doing": {
        "model": ("Model", _VIOLET),
        "answer": ("Person answers", _BLUE),
        "imitate": ("Robot imitates", _GREEN),
        "praise": ("Praise", _AMBER),
        "end": (" ", NOTHING),
    },
    "4_help": {
        "independent": ("No help", _GREEN),
        "verbal": ("Help: words", _AMBER),
        "model again": ("Help: shown again", 0xFB8C00FF),
        "partial help": ("Help: partial", 0xF4511EFF),
        "full help": ("Help: full", _RED),
        "end": (" ", NOTHING),
    },
    "5_proposed": {
        "score 0": ("0 (proposal)", _RED),
        "score 1": ("1 (proposal)", _GREEN),
        "score 2": ("2 (proposal)", _BLUE),
        "excluded": ("No trial", _SAND),
        "end": (" ", NOTHING),
    },
}
"""Lane → state → what the viewer calls it, and its colour. The viewer sorts lanes by their names, hence the numbers.
Turns, in lane ``2_turn``, are states of their own."""


def log_states(stream: rr.RecordingStream, states: Sequence[tuple[str, float, str]]) -> None:
    """Log what is known of each lane.

    Args:
        stream: an open recording.
        states: lane, seconds of the session, state; in order of time.
    """
    import rerun as rr

    for lane, start, state in states:
        with moment(stream, start):
            stream.log(f"{STORY}/{lane}", rr.StateChange(state=state))


def log_rating_lane(stream: rr.RecordingStream, lane: str) -> None:
    """Log the names and colours of what one rater scored."""
    import rerun as rr

    states = LANES["5_proposed"]
    labels = [name.replace(" (proposal)", "") for name, _ in states.values()]
    colours = [colour for _, colour in states.values()]
    config = rr.StateConfiguration(values=list(states), labels=labels, colors=colours)
    stream.log(f"{STORY}/{lane}", config, static=True)


def log_lanes(stream: rr.RecordingStream) -> None:
    """Log the names and colours of the lanes' states, once a session."""
    import rerun as rr

    for lane, states in LANES.items():
        labels, colours = zip(*states.values(), strict=True)
        stream.log(
            f"{STORY}/{lane}", rr.StateConfiguration(values=list(states), labels=labels, colors=colours), static=True
        )
