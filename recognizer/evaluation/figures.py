"""The thesis's figures of results (S21): score per gesture, against k, misclassified, confusion; two methods beside."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import matplotlib
import numpy as np

from recognizer.evaluation.cross_validation import Evaluation
from recognizer.learning.database import IRRELEVANT

matplotlib.use("Agg")
from matplotlib import pyplot as plt
from matplotlib.axes import Axes

COLOURS = {"thesis": "#8a8a8a", "body": "#1f6fb4", "thesis_static": "#8a8a8a", "static": "#1f6fb4"}
FAMILIES = {"small": "small amplitude", "large": "large amplitude", "static": "hand postures"}


def draw_figures(evaluations: Sequence[Evaluation], folder: Path) -> list[Path]:
    """Write all figures as PNG and return their paths.

    Args:
        evaluations: of the same data set by one or more methods.
        folder: made if it is not there.
    """
    folder.mkdir(parents=True, exist_ok=True)
    made = []
    for name, painter in (
        ("score_per_gesture", _scores),
        ("score_against_k", _against_k),
        ("misclassified", _misclassified),
    ):
        panels = 1 if name == "score_against_k" else len(_families(evaluations))
        figure, axes = plt.subplots(1, panels, figsize=(12, 5), squeeze=False)
        painter(list(axes[0]), evaluations)
        made.append(_save(figure, folder / f"{name}.png"))
    for evaluation in evaluations:
        families = _families(evaluations)
        figure, axes = plt.subplots(1, len(families), figsize=(7.5 * len(families), 7), squeeze=False)
        for axis, family in zip(axes[0], families, strict=True):
            _confusion(axis, evaluation, family)
        made.append(_save(figure, folder / f"confusion_{evaluation.method}.png"))
    return made


def _families(evaluations: Sequence[Evaluation]) -> list[str]:
    """Return the families in the data set: moving gestures of small and large amplitude, or static postures."""
    present = {family for e in evaluations for family in e.families.tolist()}
    return [family for family in FAMILIES if family in present]


def _save(figure: plt.Figure, path: Path) -> Path:
    figure.tight_layout()
    figure.savefig(path, dpi=110)
    plt.close(figure)
    return path


def _scores(axes: list[Axes], evaluations: Sequence[Evaluation]) -> None:
    for axis, family in zip(axes, _families(evaluations), strict=True):
        labels = sorted({label for e in evaluations for label in e.labels[e.families == family].tolist()})
        width = 0.8 / len(evaluations)
        for i, e in enumerate(evaluations):
            scores = [e.score(e.labels == label) for label in labels]
            mean = np.mean(scores) if scores else 0.0
            places = np.arange(len(labels)) + (i - (len(evaluations) - 1) / 2) * width
            axis.bar(places, scores, width, color=COLOURS[e.method], label=f"{e.method}: mean {mean:.1%}")
        axis.set(
            title=f"{FAMILIES[family]}: score per gesture, {evaluations[0].protocol}", ylim=(0, 1.15), ylabel="score"
        )
        axis.set_xticks(range(len(labels)), labels, rotation=30, ha="right")
        axis.legend(loc="upper center", ncols=len(evaluations))


def _against_k(axes: list[Axes], evaluations: Sequence[Evaluation]) -> None:
    for e in evaluations:
        axes[0].plot(list(e.by_k), list(e.by_k.values()), "o-", color=COLOURS[e.method], label=e.method)
    axes[0].set(title="score against k", xlabel="k neighbours", ylabel="score of all gestures", ylim=(0, 1.02))
    axes[0].grid(alpha=0.3)
    axes[0].legend()


def _misclassified(axes: list[Axes], evaluations: Sequence[Evaluation]) -> None:
    """How often each label is answered; the red line is how often it ought to be."""
    for axis, family in zip(axes, _families(evaluations), strict=True):
        labels = sorted({label for e in evaluations for label in e.labels[e.families == family].tolist()})
        for i, e in enumerate(evaluations):
            answered = [np.mean(e.nearest[e.gestures] == label) for label in labels]
            axis.plot(np.arange(len(labels)) + 0.04 * i, answered, "o", color=COLOURS[e.method], label=e.method)
        ideal = [np.mean(evaluations[0].labels[evaluations[0].gestures] == label) for label in labels]
        axis.plot(range(len(labels)), ideal, "r-", label="ideal")
        axis.set(title=f"{FAMILIES[family]}: share of all answers", ylim=(0, None), ylabel="share")
        axis.set_xticks(range(len(labels)), labels, rotation=30, ha="right")
        axis.legend()


def _confusion(axis: Axes, evaluation: Evaluation, family: str) -> None:
    labels, counts = evaluation.confusion(family)
    if not labels:
        axis.set_axis_off()
        return
    shares = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    axis.imshow(shares, cmap="Blues", vmin=0, vmax=1)
    for (row, column), count in np.ndenumerate(counts):
        if count:
            axis.text(
                column,
                row,
                str(count),
                ha="center",
                va="center",
                color="white" if shares[row, column] > 0.5 else "black",
            )
    columns = [*labels, f"other or {IRRELEVANT}"]
    axis.set_xticks(range(len(columns)), columns, rotation=40, ha="right")
    axis.set_yticks(range(len(labels)), labels)
    axis.set(title=f"{evaluation.method}, {FAMILIES[family]}", xlabel="answered", ylabel="true")
