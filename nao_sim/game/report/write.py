"""A report and its tables in one folder, complete or not there."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, replace
from pathlib import Path

from nao_sim.episodes.folder import complete_folder
from nao_sim.game.errors import GameError
from nao_sim.game.report.case_page import CasePage, case_page
from nao_sim.game.report.child_page import ChildPage, child_page
from nao_sim.game.report.html import render
from nao_sim.game.report.protocol_page import ProtocolPage, protocol_page
from nao_sim.game.report.rows import CHILDREN, POINTS, child_lines, point_lines
from nao_sim.game.report.study_page import StudyPage, study_page
from nao_sim.game.study import Gathered, StudyResult, study_results, trials_of
from nao_sim.game.study.single_case import BLOCK
from nao_sim.game.tables import Tables, write_tables
from nao_sim.game.tables.csv_text import to_csv
from nao_sim.game.tables.parquet import to_parquet

PAGE = "report.html"


@dataclass(frozen=True)
class Report:
    """All pages of a report, before they are printed.

    Attributes:
        children: the therapist's pages.
        studies: of each study its page, its single cases if it is made of them, and its protocol evidence.
        results: what the studies' pages were made of.
        notes: what a reader should know of the files.
    """

    children: tuple[ChildPage, ...]
    studies: tuple[tuple[StudyPage, CasePage | None, ProtocolPage], ...]
    results: tuple[StudyResult, ...]
    notes: tuple[str, ...]


def make_report(gathered: Gathered, out: Path, every_session: bool = False, block: int = BLOCK) -> Report:
    """Make the pages.

    Args:
        gathered: the sessions.
        out: the report's folder, from which films are linked.
        every_session: a therapist's page for every session of a child, not only for the latest.
        block: turns a point of a single case's graph, where a phase has too few sessions.

    Raises:
        GameError: no child was to imitate in any turn, or ``block`` is below 1.
    """
    if block < 1:
        raise GameError(f"--block is {block}; a point needs at least one turn")
    trials = trials_of(gathered.tables)
    if not trials:
        raise GameError("no turn has a child as its imitator; there is nothing to report")
    pages = []
    for child in dict.fromkeys(trial.child for trial in trials):
        mine = [trial for trial in trials if trial.child == child]
        sessions = list({t.session.session: t.session for t in mine}.values())
        chosen = sessions if every_session else sessions[-1:]
        pages += [child_page(gathered, session, child, mine, out) for session in reversed(chosen)]
    results = study_results(gathered.tables)
    studies = []
    for result in results:
        page = study_page(result)
        studies.append((page, case_page(result, block), protocol_page(result, page.title, gathered.tables)))
    return Report(tuple(pages), tuple(studies), results, gathered.notes)


def write_report(gathered: Gathered, out: Path, every_session: bool = False, block: int = BLOCK) -> Report:
    """Write ``report.html`` and the tables as CSV and Parquet; an older report there is replaced.

    Raises:
        GameError: there is nothing to report.
        EpisodeError: the folder cannot be written, or holds something that is no report.
    """
    out = out.resolve()
    _refuse_sources(gathered.folders.values(), out)
    report = make_report(gathered, out, every_session, block)
    with complete_folder(out, PAGE) as work:
        (work / PAGE).write_text(render(report), encoding="utf-8")
        write_tables(work, _from_here(gathered, out))
        for kind, rows in ((CHILDREN, child_lines(report.results)), (POINTS, point_lines(report.results, block))):
            if rows:
                (work / f"{kind.name}.csv").write_bytes(to_csv(kind, rows).encode())
                (work / f"{kind.name}.parquet").write_bytes(to_parquet(kind, rows))
    return report


def _refuse_sources(folders: Iterable[Path], out: Path) -> None:
    for folder in folders:
        if folder == out or out in folder.parents:
            raise GameError(f"{out} holds the sessions themselves; choose another folder with --out")


def _from_here(gathered: Gathered, out: Path) -> Tables:
    """Return the tables with their files' places as seen from the report."""

    def moved(session: str, path: str | None) -> str | None:
        return path and Path(os.path.relpath(gathered.folders[session] / path, out)).as_posix()

    tables = gathered.tables
    return replace(
        tables,
        sessions=tuple(replace(s, film=moved(s.session, s.film)) for s in tables.sessions),
        turns=tuple(
            replace(
                t,
                clip=moved(t.session, t.clip),
                film=moved(t.session, t.film),
                episode=moved(t.session, t.episode),
            )
            for t in tables.turns
        ),
    )
