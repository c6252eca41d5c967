"""Draw docs/gestures.jpg: every gesture of the library at its most telling moment.

python tools/render_gestures.py
"""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np

from nao_sim.episodes.film_robot import frames_of
from nao_sim.gestures import library
from nao_sim.gestures.act import act
from nao_sim.robot import Nao

OUT = Path(__file__).resolve().parents[1] / "docs" / "gestures.jpg"
COLUMNS, SIZE = 8, (170, 190)
# The moment shown, by mark, where it is not the one furthest from standing.
MARKS = ("hold", "bowed", "up")


def moment(performance):
    """Return the time to show, s."""
    marks = performance.trajectory.marks
    named = [marks[name] for name in MARKS if name in marks]
    if named:
        return named[0] + 0.1
    away = np.abs(performance.log.angles - performance.log.angles[0]).sum(axis=1)
    return float(performance.log.time[away.argmax()])


def main():
    """Draw the sheet beside this file."""
    nao, tiles = Nao(), []
    for name, gesture in library().items():
        nao.reset()
        performance = act(nao, gesture)
        (tile,) = frames_of(nao.model, performance.log, np.array([moment(performance)]), SIZE)
        cv2.putText(tile, name, (4, 12), cv2.FONT_HERSHEY_SIMPLEX, 0.36, (40, 40, 40), 1, cv2.LINE_AA)
        tiles.append(tile)
    tiles += [np.full_like(tiles[0], 255)] * (-len(tiles) % COLUMNS)
    rows = [np.hstack(tiles[first : first + COLUMNS]) for first in range(0, len(tiles), COLUMNS)]
    cv2.imwrite(
        str(OUT),
        np.vstack(rows),
        [cv2.IMWRITE_JPEG_QUALITY, 82],
    )


if __name__ == "__main__":
    main()
