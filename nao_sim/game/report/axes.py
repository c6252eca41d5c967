"""The frame of a graph of shares: 0 to 100 %, always."""

from __future__ import annotations

from dataclasses import dataclass

from nao_sim.game.report.svg import Drawing


@dataclass(frozen=True)
class Frame:
    """Where the graph lies in its drawing; pixels."""

    left: float
    top: float
    width: float
    height: float

    def y(self, share: float) -> float:
        """Return the place of a share."""
        return self.top + self.height * (1 - share)

    def draw(self, drawing: Drawing) -> None:
        """Draw the axis and its lines at every quarter."""
        for quarter in range(5):
            at = self.y(quarter / 4)
            drawing.line(self.left, at, self.left + self.width, at, "axis" if quarter == 0 else "grid")
            if quarter % 2 == 0:
                drawing.text(self.left - 6, at + 4, f"{25 * quarter} %", "tick", "end")
