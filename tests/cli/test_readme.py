"""The README tells the truth about the commands."""

from __future__ import annotations

import re
from pathlib import Path

from nao_sim.cli.app import COMMANDS

CHECKOUT = Path(__file__).resolve().parents[2]
README = (CHECKOUT / "README.md").read_text(encoding="utf-8")


def test_every_command_is_listed_and_every_listed_command_exists() -> None:
    named = set(re.findall(r"^nao-sim ([a-z]+)", README, flags=re.MULTILINE))
    assert named == set(COMMANDS)


def test_every_file_that_the_documentation_links_to_exists() -> None:
    for page in [*CHECKOUT.glob("*.md"), *CHECKOUT.glob("*/*.md"), *CHECKOUT.glob("models/*/*.md")]:
        for link in re.findall(r"\]\((?!https?:|#)([^)#]+)", page.read_text(encoding="utf-8")):
            assert (page.parent / link).exists(), f"{page.name} links to {link}"


def test_every_module_that_the_map_of_the_thesis_names_exists() -> None:
    table = (CHECKOUT / "docs" / "thesis.md").read_text(encoding="utf-8")
    for path in re.findall(r"`((?:recognizer|nao_sim|models|assets|docs)/[\w/.]*)`", table):
        assert (CHECKOUT / path).exists(), path
