"""The one HTML file: style inside, no script, nothing fetched; every text escaped."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from jinja2 import Environment, FileSystemLoader, StrictUndefined
from markupsafe import Markup

from nao_sim.game.report.words import printable
from nao_sim.resources import resource

if TYPE_CHECKING:
    from nao_sim.game.report.write import Report


@cache
def _environment() -> Environment:
    return Environment(
        loader=FileSystemLoader(resource("assets", "report")),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        finalize=lambda value: printable(value) if type(value) is str else value,
    )


def render(report: Report) -> str:
    """Return the report as HTML."""
    style = Markup(resource("assets", "report", "style.css").read_text(encoding="utf-8"))
    names: dict[str, Any] = {"report": report, "style": style}
    return _environment().get_template("report.html.j2").render(names)
