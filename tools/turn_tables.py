"""Write the lists of columns in ``docs/turns.md`` from the dataclasses (``--check``: say whether they are current)."""

from __future__ import annotations

import re
import sys
from pathlib import Path

from nao_sim.game.tables.column import Column
from nao_sim.game.tables.schema import TABLES, kind_of

PAGE = Path(__file__).parents[1] / "docs" / "turns.md"


def _line(c: Column) -> str:
    kind = c.kind + (f" [{c.unit}]" if c.unit else "") + (", may be missing" if c.optional else "")
    words = ": " + ", ".join(f"`{word}`" for word in c.words) if c.words else ""
    return f"| `{c.name}` | {kind} | {c.doc}{words} |"


def columns(name: str) -> str:
    """Return one table's list of columns as Markdown."""
    kind = kind_of(name)
    lines = ["| column | type | what it says |", "|---|---|---|", *map(_line, kind.columns + kind.derived)]
    return "\n".join(lines)


def page(text: str) -> str:
    """Return the page with its lists made anew."""
    for name in TABLES:
        pattern = rf"(<!-- columns of {name} -->\n).*?(<!-- end -->)"
        text = re.sub(pattern, lambda m, name=name: m[1] + columns(name) + "\n" + m[2], text, flags=re.DOTALL)
    return text


if __name__ == "__main__":
    old = PAGE.read_text(encoding="utf-8")
    new = page(old)
    if "--check" in sys.argv:
        raise SystemExit(0 if new == old else f"{PAGE} is not current; run python tools/turn_tables.py")
    PAGE.write_text(new, encoding="utf-8")
