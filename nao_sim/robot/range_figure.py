"""A picture of the joint ranges: documented, compiled, reached."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from nao_sim.errors import NaoSimError
from nao_sim.files import whole_file
from nao_sim.robot.validation import JointReport

_INK, _SHELL, _ACCENT, _BAD = "#33373d", "#d5d9de", "#e8600f", "#b00020"


def draw_ranges(reports: Sequence[JointReport], path: Path, title: str) -> None:
    """Draw one bar a joint: grey what is documented, orange what the joint reached, ticks the compiled ends.

    Args:
        reports: what :func:`nao_sim.robot.validation.validate_model` found.
        path: where to write; the suffix (``.png``, ``.svg``, ``.pdf``) chooses the format.
        title: a line above the picture.

    Raises:
        NaoSimError: the suffix is not a picture format.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(8, 0.27 * len(reports) + 1.2), layout="constrained")
    canvas = FigureCanvasAgg(figure)
    if path.suffix.lstrip(".") not in canvas.get_supported_filetypes():
        raise NaoSimError(f"{path}: not a picture format; use .png, .svg or .pdf")
    axes = figure.add_subplot()
    for row, report in enumerate(reports):
        low, high = report.documented
        axes.barh(row, high - low, left=low, height=0.72, color=_SHELL, label="documented" if row == 0 else None)
        if report.reached is not None:
            low, high = report.reached
            color = _BAD if report.problems else _ACCENT
            axes.barh(row, high - low, left=low, height=0.3, color=color, label="reached" if row == 0 else None)
        if report.compiled is not None:
            label = "compiled" if row == 0 else None
            axes.plot(report.compiled, [row, row], "|", color=_INK, markersize=11, label=label)
    axes.set_yticks(range(len(reports)), [report.joint for report in reports])
    axes.invert_yaxis()
    low, high = axes.get_xlim()
    axes.set_xlim(low - 5, high + 5)
    axes.axvline(0, color=_INK, linewidth=0.5)
    axes.set_xlabel("degrees (hands: per cent open)")
    axes.set_title(title, loc="left")
    axes.spines[["top", "right"]].set_visible(False)
    figure.legend(loc="outside lower right", ncols=3, frameon=False)
    with whole_file(path) as beside:
        figure.savefig(beside, dpi=110)
