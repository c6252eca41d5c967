"""Measures of a motion as numbers and as a table, for the commands that show them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from rich.table import Table

    from nao_sim.motion.measures import Measures

_EXTREMES = (
    "range_margin_deg",
    "speed_share",
    "torque_share",
    "self_distance_mm",
    "com_margin_mm",
    "tracking_deg",
)
_HEADINGS = ("s", "range", "speed", "torque", "self", "CoM", "track")
LEGEND = (
    "s: duration; range: degrees left to the nearest bound; speed: of nominal; torque: of stall; "
    "self: mm between parts of the body; CoM: mm inside the feet; track: degrees RMS of the worst joint"
)
"""What the columns are."""


def as_dict(measures: Measures) -> dict[str, Any]:
    """Return the measures as JSON has them; each extreme with its joint or pair and its time."""
    extremes = {name: getattr(measures, name) for name in _EXTREMES}
    return {
        "duration_s": round(measures.duration_s, 3),
        **{
            name: {"value": round(extreme.value, 4), "where": extreme.where, "time_s": round(extreme.time_s, 3)}
            for name, extreme in extremes.items()
        },
        "tracking_all_deg": round(measures.tracking_all_deg, 4),
        "fell_at_s": measures.fell_at,
        "ends_standing": measures.ends_standing,
    }


def table_of(rows: list[dict[str, Any]]) -> Table:
    """Return a table, a row a gesture; rows as :func:`as_dict` with ``gesture`` and ``faults``, or with ``error``."""
    from rich.markup import escape
    from rich.table import Table

    table = Table(box=None, header_style="bold", pad_edge=False)
    table.add_column("gesture", overflow="fold")
    for heading in _HEADINGS:
        table.add_column(heading, justify="right", no_wrap=True)
    table.add_column("passes", no_wrap=True)
    for row in rows:
        verdict = "[red]not read[/]" if "error" in row else "[red]no[/]" if row["faults"] else "[green]ok[/]"
        # What was refused was not played, and nothing is said that was not measured.
        cells = ["-"] * len(_HEADINGS)
        if "duration_s" in row:
            values = [row["duration_s"], *(row[name]["value"] for name in _EXTREMES)]
            formats = ("{:.1f}", "{:.1f}", "{:.2f}", "{:.2f}", "{:.0f}", "{:.0f}", "{:.2f}")
            cells = [form.format(value) for form, value in zip(formats, values, strict=True)]
        table.add_row(escape(row["gesture"]), *cells, verdict)
    return table
