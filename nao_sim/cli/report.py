"""``nao-sim report``."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

if TYPE_CHECKING:
    from nao_sim.game.report import Report


def report(
    places: Annotated[list[Path], typer.Argument(metavar="DIR...", help="Folders of played sessions, or above them.")],
    out: Annotated[Path, typer.Option(help="Folder of the report.")] = Path("report"),
    every_session: Annotated[
        bool, typer.Option("--every-session", help="A therapist's page a session, not only of each child's latest.")
    ] = False,
    block: Annotated[
        int, typer.Option(help="Turns a point in a single case's graph, where a phase has too few sessions.")
    ] = 5,
    as_json: Annotated[bool, typer.Option("--json", help="Print the results as JSON.")] = False,
) -> None:
    """Gather sessions into one HTML file that needs no network, and their tables as CSV and Parquet."""
    from rich.console import Console
    from rich.markup import escape

    from nao_sim.game.report import write_report
    from nao_sim.game.study import gather

    made = write_report(gather(places), out, every_session, block)
    if as_json:
        typer.echo(json.dumps(_as_dict(made, out), indent=2, ensure_ascii=False, allow_nan=False))
        return
    console = Console(soft_wrap=True)
    for page in made.children:
        console.print(f"[bold]{escape(page.child)}[/]  {escape(page.session)}  {escape(page.headline)}")
    for study, _, _ in made.studies:
        console.print(f"[bold]{escape(study.title)}[/]")
        for line in (*study.obstacles, *study.verdicts):
            console.print(f"  {escape(line)}")
    for note in made.notes:
        console.print(f"[yellow]note[/] {escape(note)}")
    console.print(f"written {escape(str(out))}/report.html and its tables")


def _as_dict(made: Report, out: Path) -> dict[str, Any]:
    studies = []
    for result in made.results:
        found, verdicts = result.comparison, result.verdicts
        studies.append(
            {
                "study": result.study,
                "design": result.design,
                "outcome": result.outcome,
                "children": {c: len(result.of(c)) for c in ("triadic", "dyadic")},
                "means": {c: _number(result.mean(c)) for c in ("triadic", "dyadic")},
                "difference": _number(found.difference) if found else None,
                "p": found.p if found else None,
                "extreme": found.extreme if found else None,
                "ways": found.ways if found else None,
                "smallest_p": found.smallest_p if found else None,
                "interval": found.interval if found else None,
                "equivalence_p": found.equivalence_p if found else None,
                "verdicts": {
                    "different": verdicts.different,
                    "equivalent": verdicts.equivalent,
                    "too_few": verdicts.too_few,
                }
                if verdicts
                else None,
                "obstacles": result.obstacles,
            }
        )
    pages = [{"child": p.child, "session": p.session, "headline": p.headline, "to_do": p.to_do} for p in made.children]
    return {"report": str(out / "report.html"), "children": pages, "studies": studies, "notes": made.notes}


def _number(value: Any) -> float | None:
    return None if value is None else float(value)
