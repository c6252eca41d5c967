"""A drawing as inline SVG; all text goes through an XML tree, so that nothing in it is ever markup."""

from __future__ import annotations

from xml.etree import ElementTree

from markupsafe import Markup

from nao_sim.game.report.words import printable


class Drawing:
    """A drawing in pixels, y downwards; classes are styled by the report's style sheet.

    Args:
        width: of the view.
        height: of the view.
        says: what the picture shows, for those who do not see it.
    """

    def __init__(self, width: float, height: float, says: str) -> None:
        self._root = ElementTree.Element(
            "svg", {"viewBox": f"0 0 {width:g} {height:g}", "role": "img", "aria-label": printable(says)}
        )

    def line(self, x1: float, y1: float, x2: float, y2: float, css: str) -> None:
        """Draw a line."""
        ends = {"x1": x1, "y1": y1, "x2": x2, "y2": y2}
        self._add("line", css, {k: f"{v:.1f}" for k, v in ends.items()})

    def polyline(self, points: list[tuple[float, float]], css: str) -> None:
        """Join points; one alone is nothing."""
        if len(points) > 1:
            self._add("polyline", css, {"points": " ".join(f"{x:.1f},{y:.1f}" for x, y in points)})

    def dot(self, x: float, y: float, css: str, hover: str = "", radius: float = 4.5) -> None:
        """Draw a point, round."""
        self._add("circle", css, {"cx": f"{x:.1f}", "cy": f"{y:.1f}", "r": f"{radius:g}"}, hover)

    def square(self, x: float, y: float, css: str, hover: str = "", half: float = 4.2) -> None:
        """Draw a point, square."""
        size = {"x": x - half, "y": y - half, "width": 2 * half, "height": 2 * half}
        self._add("rect", css, {k: f"{v:.1f}" for k, v in size.items()}, hover)

    def text(self, x: float, y: float, text: str, css: str = "", anchor: str = "middle") -> None:
        """Write text; ``anchor`` is start, middle or end."""
        found = self._add("text", css, {"x": f"{x:.1f}", "y": f"{y:.1f}", "text-anchor": anchor})
        found.text = printable(text)

    def _add(self, tag: str, css: str, values: dict[str, str], hover: str = "") -> ElementTree.Element:
        element = ElementTree.SubElement(self._root, tag, values | ({"class": css} if css else {}))
        if hover:
            ElementTree.SubElement(element, "title").text = printable(hover)
        return element

    def markup(self) -> Markup:
        """Return the drawing for a template."""
        return Markup(ElementTree.tostring(self._root, encoding="unicode"))
