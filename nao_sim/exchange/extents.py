"""Where a turn lies in time, and stretches side by side that must not overlap."""

from __future__ import annotations

from nao_sim.game.tables import Turn


def extent(turn: Turn) -> tuple[float, float] | None:
    """Return the first and last recorded time of a turn in seconds; None where it has none."""
    times = [turn.instruction_s, turn.model_start_s, turn.model_end_s, turn.movement_start_s, turn.movement_end_s]
    times += [turn.prompt_s, turn.praise_s]
    if turn.model_end_s is not None and turn.waited_s is not None:
        times.append(turn.model_end_s + turn.waited_s)
    if turn.model_end_s is not None and turn.latency_s is not None:
        times.append(turn.model_end_s + turn.latency_s)
    known = [time for time in times if time is not None]
    return (min(known), max(known)) if known else None


def apart(stretches: list[tuple[int, int]]) -> list[tuple[int, int]]:
    """Return stretches, in their order of start, of at least 1 and without overlap: an earlier one ends for a later."""
    found: list[tuple[int, int]] = []
    for start, end in stretches:
        if found and start <= found[-1][0]:
            start = found[-1][0] + 1
        if found and found[-1][1] > start:
            found[-1] = (found[-1][0], start)
        found.append((start, max(end, start + 1)))
    return found
