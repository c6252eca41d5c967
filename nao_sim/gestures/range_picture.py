"""A picture of how much of each joint's range motions use."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from nao_sim.files import whole_file
from nao_sim.robot import ACTUATED


def draw_range_use(use: Mapping[str, NDArray[np.float64]], path: Path) -> None:
    """Draw, for each joint, the part of its range that each motion uses.

    Args:
        use: motion → lowest and highest target of each joint, 0 its lower and 1 its upper bound, shape (25, 2).
        path: a picture file that Matplotlib can write (.png, .svg, .pdf); replaced as a whole.

    Raises:
        ValueError: the suffix is not a picture's.
    """
    from matplotlib.backends.backend_agg import FigureCanvasAgg  # heavy, and only needed here
    from matplotlib.figure import Figure

    figure = Figure(figsize=(11, 4.0), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots()
    step = 0.8 / max(len(use), 1)
    colours = ["#1f6fb2", "#f0821e", "#3a9a5b", "#8a5bb0", "#b23a48", "#777777"]
    for row, (name, spans) in enumerate(use.items()):
        at = np.arange(len(ACTUATED)) - 0.4 + step * (row + 0.5)
        height = np.maximum(spans[:, 1] - spans[:, 0], 0.015)
        axes.bar(at, height, 0.9 * step, bottom=spans[:, 0], color=colours[row % len(colours)], label=name)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.axhline(1, color="black", linewidth=0.8)
    axes.set_xticks(range(len(ACTUATED)), ACTUATED, rotation=60, ha="right")
    axes.set_yticks([0, 0.5, 1], ["lower bound", "middle", "upper bound"])
    axes.set_ylim(-0.05, 1.05)
    axes.set_xlim(-0.6, len(ACTUATED) - 0.4)
    axes.set_title("Use of each joint's range")
    if len(use) <= 12:
        figure.legend(ncols=4, fontsize="small", loc="outside lower center", frameon=False)
    with whole_file(path) as beside:
        figure.savefig(beside, dpi=110)
