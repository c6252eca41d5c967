"""Sessions whose turns are the sample clips: quick to play, and everybody knows what they show."""

from __future__ import annotations

from pathlib import Path

from nao_sim.resources import resource

HEAD = """
session = "{name}"
[study]
condition = "dyadic"
design = "groups"
[game]
gestures = ["bye_right", "stop"]
order = "fixed"
baseline = {baseline}
turns = {turns}
{game}
[[participant]]
id = "C01"
role = "child"
models = "unseen"
turns = {{ films = [{films}], {more} }}
[[participant]]
id = "T01"
role = "therapist"
turns = "unseen"
{rest}
"""


def clip(name: str) -> str:
    """A sample clip as a session file names it."""
    return f'"{resource("assets", "clips", f"{name}.avi")}"'


def write_session(
    path: Path,
    films: list[str],
    *,
    name: str = "S1",
    baseline: int = 0,
    turns: int | None = None,
    game: str = "",
    more: str = "starts_at_model_end = true",
    rest: str = "",
) -> Path:
    """Write a dyadic session in which the child's answers are these entries, each already TOML."""
    count = len(films) - baseline if turns is None else turns
    text = HEAD.format(
        name=name, baseline=baseline, turns=count, game=game, films=", ".join(films), more=more, rest=rest
    )
    path.write_text(text, encoding="utf-8")
    return path
