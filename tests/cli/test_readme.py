"""The README tells the truth about the commands."""

from __future__ import annotations

import re
from pathlib import Path

from nao_sim.cli.app import COMMANDS

CHECKOUT = Path(__file__).resolve().parents[2]
README = (CHECKOUT / "README.md").read_text(encoding="utf-8")
PAGES = [
    page
    for folder in (".", "docs", "findings", "tools", "models/nao", "models/person")
    for page in (CHECKOUT / folder).glob("*.md")
    if page.name != "CHANGELOG.md"  # which tells of what was
]


def test_every_command_is_listed_and_every_listed_command_exists() -> None:
    named = set(re.findall(r"^nao-sim ([a-z]+)", README, flags=re.MULTILINE))
    assert named == set(COMMANDS)


def test_every_file_that_the_documentation_links_to_exists() -> None:
    for page in PAGES:
        for link in re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name} links to {link}"


def test_every_file_of_ours_that_the_documentation_names_exists() -> None:
    folders = "recognizer|nao_sim|models|assets|docs|tools|tests|benchmarks|examples"
    for page in PAGES:
        for path in re.findall(rf"[` ]((?:{folders})/[\w/.]*\w/?)[` ]", page.read_text(encoding="utf-8")):
            assert (CHECKOUT / path).exists(), f"{page.name} names {path}"
